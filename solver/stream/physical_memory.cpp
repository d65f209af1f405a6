#include "solver/stream/physical_memory.h"

#include "gpu/draw.h"

namespace tidemark::solver {

std::int64_t PhysicalMemory::bytes_for(const PackedLayout& layout, std::int64_t capacity) {
  constexpr std::int64_t kPhiBytes = 2 * 4;
  const auto motion = static_cast<std::int64_t>(sizeof(PageMotion));
  return layout.rounded_up(capacity) * (layout.layout().voxels_per_page() * kPhiBytes + motion);
}

Result<PhysicalMemory::Motion> PhysicalMemory::make_motion(gpu::Device& device, const PackedLayout& layout,
                                                           std::int64_t capacity) {
  const std::int64_t width = layout.pages_per_row();
  auto texture = gpu::Texture2D::create(device, gpu::TexelFormat::rgba32f, width,
                                        layout.rounded_up(capacity) / width, "motion of pages");
  if (!texture) return pass_on(texture);
  auto target = gpu::Framebuffer::create(device, {&*texture}, "motion of pages");
  if (!target) return pass_on(target);
  target->bind();
  gpu::clear_colours(1);
  return Motion{std::move(*texture), std::move(*target)};
}

Status PhysicalMemory::make_targets(gpu::Device& device) {
  std::vector<Layer> layers;
  for (std::int64_t layer = 0; layer < field_.phi(0).layers(); ++layer) {
    const auto make = [&](std::initializer_list<const gpu::TextureLayers*> textures) {
      return gpu::Framebuffer::create_on_layer(device, layer, textures, "G");
    };
    auto first = make({&field_.phi(0)});
    auto second = make({&field_.phi(1)});
    auto both = make({&field_.phi(0), &field_.phi(1)});
    for (auto* made : {&first, &second, &both}) {
      if (!*made) return pass_on(*made);
    }
    layers.push_back({{std::move(*first), std::move(*second), std::move(*both)}});
  }
  layers_ = std::move(layers);
  return {};
}

Result<PhysicalMemory> PhysicalMemory::create(gpu::Device& device, const PackedLayout& layout,
                                              std::int64_t capacity, float band) {
  auto field = PackedField::create(device, layout, capacity, band);
  if (!field) return pass_on(field);
  auto motion = make_motion(device, layout, capacity);
  if (!motion) return pass_on(motion);
  PhysicalMemory memory;
  memory.field_ = std::move(*field);
  memory.motion_ = std::move(motion->texture);
  memory.motion_target_ = std::move(motion->target);
  TIDEMARK_TRY(memory.make_targets(device));
  return memory;
}

Status PhysicalMemory::grow(gpu::Device& device, std::int64_t capacity) {
  auto motion = make_motion(device, field_.layout(), capacity);
  if (!motion) return pass_on(motion);
  motion_target_.copy_to({0, 0, motion_.width(), motion_.height()}, motion->texture, 0, 0);
  TIDEMARK_TRY(field_.grow(device, capacity));
  motion_ = std::move(motion->texture);
  motion_target_ = std::move(motion->target);
  return make_targets(device);
}

Result<std::vector<PageMotion>> PhysicalMemory::read_motion() const {
  std::vector<PageMotion> pages(static_cast<std::size_t>(motion_.width() * motion_.height()));
  TIDEMARK_TRY(
      motion_.download({0, 0, motion_.width(), motion_.height()}, std::as_writable_bytes(std::span(pages))));
  return pages;
}

gpu::TexelRect PhysicalMemory::motion_texel(PhysicalPage page) const {
  return {page % motion_.width(), page / motion_.width(), 1, 1};
}

// A page of this executor is a tile in the order of its voxels.
Result<std::vector<float>> PhysicalMemory::read_page(PhysicalPage page, int buffer) const {
  std::vector<float> voxels(static_cast<std::size_t>(field_.layout().layout().voxels_per_page()));
  TIDEMARK_TRY(field_.phi(buffer).download(field_.layout().layer(page), field_.layout().rect(page),
                                           std::as_writable_bytes(std::span(voxels))));
  return voxels;
}

Result<PageMotion> PhysicalMemory::read_motion(PhysicalPage page) const {
  PageMotion motion;
  TIDEMARK_TRY(motion_.download(motion_texel(page), std::as_writable_bytes(std::span(&motion, 1))));
  return motion;
}

Result<PhysicalMemory::Kept> PhysicalMemory::keep(std::span<const PhysicalPage> pages, int buffer) const {
  Kept kept;
  for (const PhysicalPage page : pages) {
    auto phi = read_page(page, buffer);
    if (!phi) return pass_on(phi);
    auto motion = read_motion(page);
    if (!motion) return pass_on(motion);
    kept.pages.push_back(page);
    kept.phi.push_back(std::move(*phi));
    kept.motion.push_back(*motion);
  }
  return kept;
}

void PhysicalMemory::put_back(const Kept& kept, int buffer) {
  for (std::size_t i = 0; i < kept.pages.size(); ++i) {
    field_.upload_page(kept.pages[i], kept.phi[i], buffer);
    motion_.upload(motion_texel(kept.pages[i]), std::as_bytes(std::span(&kept.motion[i], 1)));
  }
}

}  // namespace tidemark::solver
