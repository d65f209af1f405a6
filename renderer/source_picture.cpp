#include "renderer/source_picture.h"

#include <algorithm>
#include <variant>

#include "core/thread_pool.h"
#include "core/typed_volume.h"
#include "renderer/source_stack.h"

namespace tidemark::renderer {
namespace {

// Least and greatest value in each page and one voxel around it: what filtering reaches from inside the page.
template <class Stored>
std::vector<glm::vec2> page_ranges(const TypedVolume<Stored>& source, const solver::PageLayout& layout) {
  ThreadPool pool;
  std::vector<glm::vec2> ranges(static_cast<std::size_t>(layout.page_count()));
  const auto measure = [&](std::int64_t page) -> glm::vec2 {
    const Index3 first = layout.first_voxel(page);
    const Index3 low = glm::max(first - Index3(1), Index3(0));
    const Index3 high = glm::min(first + layout.valid_shape(page), source.geometry.size - Index3(1));
    Stored lowest = source.stored[static_cast<std::size_t>(source.geometry.offset(first))];
    Stored highest = lowest;
    for (std::int64_t z = low.z; z <= high.z; ++z) {
      for (std::int64_t y = low.y; y <= high.y; ++y) {
        const Stored* row = source.stored.data() + source.geometry.offset({0, y, z});
        for (std::int64_t x = low.x; x <= high.x; ++x) {
          lowest = std::min(lowest, row[x]);
          highest = std::max(highest, row[x]);
        }
      }
    }
    const auto [least, greatest] = std::minmax({source.rescaled(lowest), source.rescaled(highest)});
    return {least, greatest};
  };
  pool.for_each(layout.page_count(), 64, [&](std::int64_t begin, std::int64_t end, int) {
    for (std::int64_t page = begin; page < end; ++page)
      ranges[static_cast<std::size_t>(page)] = measure(page);
  });
  return ranges;
}

}  // namespace

Result<SourcePicture> SourcePicture::create(gpu::Device& device, const Volume& source,
                                            const solver::PageLayout& layout, std::int64_t largest) {
  SourcePicture picture;
  picture.layout_ = layout;
  picture.unit_ = 1.0F / glm::vec3(source.geometry.size);
  const auto [format, scale] = stored_as(source);
  picture.scale_ = scale;
  const Index3 size = source.geometry.size;
  picture.has_volume_ = std::max({size.x, size.y, size.z}) <= largest;
  const auto make_texture = [&, format = format](Index3 extent, std::span<const std::byte> texels) {
    return gpu::Texture3D::create(device, format, extent, texels, "source for pictures", gpu::Filter::linear);
  };
  const std::vector<std::byte> nothing(static_cast<std::size_t>(gpu::bytes_per_texel(format)));
  auto texture =
      picture.has_volume_
          ? std::visit(
                [&](const auto& voxels) { return make_texture(size, std::as_bytes(std::span(voxels))); },
                source.voxels)
          : make_texture(Index3(1), nothing);
  if (!texture && picture.has_volume_ && !device.lost()) {
    // The GPU's memory is too small for it; slices will do.
    picture.has_volume_ = false;
    texture = make_texture(Index3(1), nothing);
  }
  if (!texture) return pass_on(texture);
  picture.texture_ = std::move(*texture);
  auto buffer = gpu::Buffer::create(
      device, layout.page_count() * static_cast<std::int64_t>(sizeof(glm::vec4)), "page opacities");
  if (!buffer) return pass_on(buffer);
  picture.opacity_buffer_ = std::move(*buffer);
  auto view = gpu::BufferTexture::create(device, picture.opacity_buffer_, gpu::TexelFormat::rgba32f,
                                         "page opacities");
  if (!view) return pass_on(view);
  picture.opacities_ = std::move(*view);
  return picture;
}

void SourcePicture::set_transfer_function(const Volume& source, const TransferFunction& function,
                                          Region region, double band) {
  Shown wanted{function, region, band};
  if (shown_ == wanted) return;
  if (ranges_.empty()) {
    ranges_ = with_type(source, [&](const auto& typed) { return page_ranges(typed, layout_); });
  }
  page_opacities_.clear();
  page_opacities_.reserve(ranges_.size());
  for (const glm::vec2 range : ranges_) {
    const auto most = [&](double low_phi, double high_phi) {
      return function.most_opacity(range.x, range.y, low_phi, high_phi);
    };
    // Of a page that is outside throughout, inside throughout, or holds the surface.
    page_opacities_.emplace_back(region == Region::inside ? 0.0 : most(-band, -band),
                                 region == Region::outside ? 0.0 : most(band, band), most(-band, band), 0.0);
  }
  opacity_buffer_.upload_values<glm::vec4>(0, page_opacities_);
  shown_ = std::move(wanted);
}

void SourcePicture::set_uniforms(const gpu::Program& program, int unit) const {
  texture_.bind(static_cast<unsigned>(unit));
  program.set("source_values", unit);
  program.set("source_scale", scale_);
  program.set("source_unit", unit_);
  opacities_.bind(static_cast<unsigned>(unit + 1));
  program.set("page_opacity", unit + 1);
}

}  // namespace tidemark::renderer
