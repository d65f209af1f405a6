#include "solver/gl/packed_field.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace tidemark::solver {

Result<PackedField> PackedField::create(gpu::Device& device, const PackedLayout& layout,
                                        std::int64_t capacity, float band, int buffers) {
  const std::vector<gpu::TexelFormat> formats(static_cast<std::size_t>(buffers), gpu::TexelFormat::r32f);
  auto textures = PackedTextures::create(device, layout, capacity, formats, "physical memory G");
  if (!textures) return pass_on(textures);
  PackedField field;
  field.textures_ = std::move(*textures);
  field.write_static_pages(band);
  TIDEMARK_TRY(device.check("making physical memory"));
  return field;
}

void PackedField::write_static_pages(float band) {
  std::vector<float> values(static_cast<std::size_t>(layout().layout().voxels_per_page()));
  for (const PhysicalPage page : {kOutsidePage, kInsidePage}) {
    std::fill(values.begin(), values.end(), page == kInsidePage ? band : -band);
    for (std::size_t buffer = 0; buffer < textures_.count(); ++buffer)
      textures_.upload_tile(buffer, page, std::as_bytes(std::span(values)));
  }
}

void PackedField::upload(const SharedPages& pages) {
  const std::vector<std::int64_t> stored = pages.stored_pages();
  std::vector<PhysicalPage> physical(stored.size());
  std::iota(physical.begin(), physical.end(), kFirstPage);
  for (std::size_t buffer = 0; buffer < textures_.count(); ++buffer)
    textures_.upload(buffer, physical, [&](std::size_t i) { return pages.values(stored[i]); });
}

void PackedField::upload_page(PhysicalPage page, std::span<const float> tile, int buffer) {
  textures_.upload_tile(static_cast<std::size_t>(buffer), page, std::as_bytes(tile));
}

Result<std::vector<float>> PackedField::download(int buffer) const {
  const gpu::TextureLayers& texture = phi(buffer);
  std::vector<float> texels(static_cast<std::size_t>(texture.width() * texture.height()));
  const std::int64_t voxels = layout().layout().voxels_per_page();
  std::vector<float> pages(static_cast<std::size_t>(capacity() * voxels));
  std::int64_t there = -1;  // the layer that `texels` has
  for (PhysicalPage page = 0; page < capacity(); ++page) {
    if (const std::int64_t layer = layout().layer(page); layer != there) {
      TIDEMARK_TRY(texture.download(layer, {0, 0, texture.width(), texture.height()},
                                    std::as_writable_bytes(std::span(texels))));
      there = layer;
    }
    const gpu::TexelRect rect = layout().rect(page);
    layout().unpack(texels.data() + rect.y * texture.width() + rect.x, texture.width(),
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
