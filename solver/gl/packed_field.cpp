#include "solver/gl/packed_field.h"

#include "gpu/framebuffer.h"

namespace tidemark::solver {

Result<std::vector<gpu::TextureLayers>> PackedField::make_textures(gpu::Device& device,
                                                                   const PackedLayout& layout,
                                                                   std::int64_t capacity, std::size_t count) {
  if (capacity > layout.largest_capacity()) {
    return fail(ErrorKind::capability, "the surface needs {} pages; this driver's textures hold {}", capacity,
                layout.largest_capacity());
  }
  const Index3 size = layout.texture_size(capacity);
  std::vector<gpu::TextureLayers> textures(count);
  for (gpu::TextureLayers& texture : textures) {
    auto made = gpu::TextureLayers::create(device, gpu::TexelFormat::r32f, size.x, size.y, size.z,
                                           "physical memory G");
    if (!made) return pass_on(made);
    texture = std::move(*made);
  }
  return textures;
}

Result<PackedField> PackedField::create(gpu::Device& device, const PackedLayout& layout,
                                        std::int64_t capacity, float band, int buffers) {
  auto textures = make_textures(device, layout, capacity, static_cast<std::size_t>(buffers));
  if (!textures) return pass_on(textures);
  PackedField field;
  field.layout_ = layout;
  field.capacity_ = layout.rounded_up(capacity);
  field.band_ = band;
  field.phi_ = std::move(*textures);
  field.write_static_pages();
  TIDEMARK_TRY(device.check("making physical memory"));
  return field;
}

void PackedField::write_static_pages() {
  const gpu::TexelRect outside = layout_.rect(kOutsidePage);
  std::vector<float> values(static_cast<std::size_t>(outside.width * outside.height));
  for (const PhysicalPage page : {kOutsidePage, kInsidePage}) {
    std::fill(values.begin(), values.end(), page == kInsidePage ? band_ : -band_);
    for (gpu::TextureLayers& texture : phi_)
      texture.upload(layout_.layer(page), layout_.rect(page), std::as_bytes(std::span(values)));
  }
}

Status PackedField::grow(gpu::Device& device, std::int64_t capacity) {
  auto textures = make_textures(device, layout_, capacity, phi_.size());
  if (!textures) return pass_on(textures);
  for (std::size_t buffer = 0; buffer < phi_.size(); ++buffer) {
    const gpu::TextureLayers& old = phi_[buffer];
    for (std::int64_t layer = 0; layer < old.layers(); ++layer) {
      auto source = gpu::Framebuffer::create_on_layer(device, layer, {&old}, "growing G");
      if (!source) return pass_on(source);
      source->copy_to({0, 0, old.width(), old.height()}, (*textures)[buffer], layer);
    }
  }
  TIDEMARK_TRY(device.check("growing physical memory"));
  phi_ = std::move(*textures);
  capacity_ = layout_.rounded_up(capacity);
  return {};
}

void PackedField::upload(const SharedPages& pages) {
  const std::vector<std::int64_t> stored = pages.stored_pages();
  const auto count = static_cast<std::int64_t>(stored.size());
  const std::int64_t row_length = phi_[0].width();
  const glm::i64vec2 tile = layout_.tile();
  // Whole rows of tiles at a time; the static pages are the first two of the first row.
  std::vector<float> rows(static_cast<std::size_t>(row_length * tile.y));
  const std::int64_t per_row = layout_.pages_per_row();
  for (std::int64_t row = 0; row * per_row < count + kFirstPage; ++row) {
    for (std::int64_t column = 0; column < per_row; ++column) {
      const std::int64_t index = row * per_row + column - kFirstPage;
      if (index < 0 || index >= count) continue;
      layout_.pack(pages.values(stored[static_cast<std::size_t>(index)]), rows.data() + column * tile.x,
                   row_length);
    }
    for (gpu::TextureLayers& texture : phi_) {
      const auto first = static_cast<PhysicalPage>(row * per_row);
      texture.upload(layout_.layer(first), {0, layout_.rect(first).y, row_length, tile.y},
                     std::as_bytes(std::span(rows)));
    }
  }
  write_static_pages();
}

void PackedField::upload_page(PhysicalPage page, std::span<const float> tile, int buffer) {
  phi_[static_cast<std::size_t>(buffer)].upload(layout_.layer(page), layout_.rect(page), std::as_bytes(tile));
}

Result<std::vector<float>> PackedField::download(int buffer) const {
  const gpu::TextureLayers& texture = phi(buffer);
  std::vector<float> texels(static_cast<std::size_t>(texture.width() * texture.height()));
  const std::int64_t voxels = layout_.layout().voxels_per_page();
  std::vector<float> pages(static_cast<std::size_t>(capacity_ * voxels));
  std::int64_t there = -1;  // the layer that `texels` has
  for (PhysicalPage page = 0; page < capacity_; ++page) {
    if (const std::int64_t layer = layout_.layer(page); layer != there) {
      TIDEMARK_TRY(texture.download(layer, {0, 0, texture.width(), texture.height()},
                                    std::as_writable_bytes(std::span(texels))));
      there = layer;
    }
    const gpu::TexelRect rect = layout_.rect(page);
    layout_.unpack(texels.data() + rect.y * texture.width() + rect.x, texture.width(),
                   pages.data() + page * voxels);
  }
  return pages;
}

void update(Field& phi, std::span<const PhysicalPage> table, std::span<const float> physical) {
  const std::int64_t voxels = phi.layout.voxels_per_page();
  for (std::int64_t page = 0; page < phi.layout.page_count(); ++page) {
    const PhysicalPage from = table[static_cast<std::size_t>(page)];
    if (is_static_page(from)) {
      phi.pages.set_constant(page, from == kInsidePage ? Field::Kind::inside : Field::Kind::outside);
    } else {
      phi.update_page(page, physical.data() + from * voxels);
    }
  }
}

}  // namespace tidemark::solver
