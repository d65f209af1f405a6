#include "renderer/view_data.h"

#include <algorithm>
#include <variant>

namespace tidemark {
namespace {

// Least and greatest value in each page and one voxel around it: what filtering reaches from inside the page.
std::vector<glm::vec2> page_ranges(const Volume& source, const PageLayout& layout, ThreadPool& pool) {
  std::vector<glm::vec2> ranges(static_cast<std::size_t>(layout.page_count()));
  const Geometry& geometry = source.geometry;
  pool.for_each(layout.page_count(), 64, [&](std::int64_t begin, std::int64_t end, int) {
    for (std::int64_t page = begin; page < end; ++page) {
      const Index3 first = layout.first_voxel(page);
      const Index3 low = glm::max(first - Index3(1), Index3(0));
      const Index3 high = glm::min(first + layout.valid_shape(page), geometry.size - Index3(1));
      float least = source.value(first);
      float greatest = least;
      std::visit(
          [&](const auto& voxels) {
            auto lowest = voxels[static_cast<std::size_t>(geometry.offset(first))];
            auto highest = lowest;
            for (std::int64_t z = low.z; z <= high.z; ++z) {
              for (std::int64_t y = low.y; y <= high.y; ++y) {
                const auto* row = voxels.data() + geometry.offset({0, y, z});
                for (std::int64_t x = low.x; x <= high.x; ++x) {
                  lowest = std::min(lowest, row[x]);
                  highest = std::max(highest, row[x]);
                }
              }
            }
            const double a = source.slope * static_cast<double>(lowest) + source.intercept;
            const double b = source.slope * static_cast<double>(highest) + source.intercept;
            least = static_cast<float>(std::min(a, b));
            greatest = static_cast<float>(std::max(a, b));
          },
          source.voxels);
      ranges[static_cast<std::size_t>(page)] = {least, greatest};
    }
  });
  return ranges;
}

}  // namespace

Result<SourcePicture> SourcePicture::create(gpu::Device& device, const Volume& source,
                                            const PageLayout& layout, ThreadPool& pool) {
  SourcePicture picture;
  const auto stored = [](const auto& voxels) -> std::pair<gpu::TexelFormat, double> {
    using Scalar = typename std::decay_t<decltype(voxels)>::value_type;
    if constexpr (std::is_same_v<Scalar, std::int16_t>) return {gpu::TexelFormat::r16_snorm, 32767.0};
    if constexpr (std::is_same_v<Scalar, std::uint16_t>) return {gpu::TexelFormat::r16_unorm, 65535.0};
    return {gpu::TexelFormat::r32f, 1.0};
  };
  auto texture = std::visit(
      [&](const auto& voxels) {
        const auto [format, full] = stored(voxels);
        picture.scale_ = glm::vec2(source.slope * full, source.intercept);
        return gpu::Texture3D::create(device, format, source.geometry.size, std::as_bytes(std::span(voxels)),
                                      "source for pictures", gpu::Filter::linear);
      },
      source.voxels);
  if (!texture) return pass_on(texture);
  picture.texture_ = std::move(*texture);
  const std::vector<glm::vec2> ranges = page_ranges(source, layout, pool);
  auto buffer = gpu::Buffer::create(device, static_cast<std::int64_t>(ranges.size() * sizeof(glm::vec2)),
                                    "page ranges");
  if (!buffer) return pass_on(buffer);
  picture.range_buffer_ = std::move(*buffer);
  picture.range_buffer_.upload_values<glm::vec2>(0, ranges);
  auto view =
      gpu::BufferTexture::create(device, picture.range_buffer_, gpu::TexelFormat::rg32f, "page ranges");
  if (!view) return pass_on(view);
  picture.ranges_ = std::move(*view);
  return picture;
}

void SourcePicture::set_uniforms(const gpu::Program& program, int unit) const {
  texture_.bind(static_cast<unsigned>(unit));
  program.set("source_values", unit);
  program.set("source_scale", scale_);
  ranges_.bind(static_cast<unsigned>(unit + 1));
  program.set("page_range", unit + 1);
}

Result<PhiPicture> PhiPicture::create(gpu::Device& device, const Field& phi) {
  PhiPicture picture;
  const PackedLayout layout(phi.layout, device.capabilities().largest_texture);
  auto field =
      PackedField::create(device, layout, phi.resident_pages() + kFirstPage, static_cast<float>(phi.band));
  if (!field) return pass_on(field);
  picture.field_ = std::move(*field);
  picture.field_.upload(phi.pages);
  picture.band_ = static_cast<float>(phi.band);
  std::vector<std::int32_t> table(phi.table.size());
  std::transform(phi.table.begin(), phi.table.end(), table.begin(), [](std::int32_t entry) {
    return entry >= 0 ? entry + kFirstPage : entry == Field::kInside ? kInsidePage : kOutsidePage;
  });
  auto buffer = gpu::Buffer::create(device, static_cast<std::int64_t>(table.size()) * 4, "page table");
  if (!buffer) return pass_on(buffer);
  picture.table_buffer_ = std::move(*buffer);
  picture.table_buffer_.upload_values<std::int32_t>(0, table);
  auto view = gpu::BufferTexture::create(device, picture.table_buffer_, gpu::TexelFormat::r32i, "page table");
  if (!view) return pass_on(view);
  picture.table_ = std::move(*view);
  return picture;
}

void PhiPicture::set_uniforms(const gpu::Program& program, int unit) const {
  layout().set_uniforms(program);
  field_.phi(0).bind(static_cast<unsigned>(unit));
  program.set("phi_pages", unit);
  table_.bind(static_cast<unsigned>(unit + 1));
  program.set("page_table", unit + 1);
  program.set("band", band_);
}

}  // namespace tidemark
