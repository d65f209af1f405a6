// The passes that change pages apart from the solver's steps: filling, copying, painting.
#include <algorithm>

#include "solver/stream/region_passes.h"

namespace tidemark::solver {
namespace {

constexpr std::int64_t kPageSide = GeometryEngine::kPageSide;
constexpr std::int64_t kPlacesPerRow = GeometryEngine::kPlacesPerRow;
constexpr std::int64_t kPageTexels = kPageSide * kPageSide;

}  // namespace

void RegionPasses::fill(const GeometryEngine& geometry, const PhysicalMemory& memory, float value) const {
  fill_.use();
  fill_.set("value", glm::vec4(value));
  draw_into_memory(fill_, geometry, {0, geometry.size()}, memory, PhysicalMemory::Target::both);
  memory.draw_into_motion();
  fill_points_.use();
  fill_points_.set("value", glm::vec4(0.0F));
  geometry.draw(fill_points_, Substream::page_point, 0, geometry.size(), memory.motion_size());
}

void RegionPasses::copy(const GeometryEngine& geometry, const PhysicalMemory& memory, int now) const {
  use(copy_, memory);
  memory.field().phi(now).bind(1);
  copy_.set("phi_now", 1);
  draw_into_memory(copy_, geometry, {0, geometry.size()}, memory, PhysicalMemory::target(1 - now));
}

Status RegionPasses::paint(gpu::Device& device, const GeometryEngine& geometry, const PhysicalMemory& memory,
                           std::span<const float> values, gpu::Blending blending) const {
  const std::int64_t most = std::min<std::int64_t>(geometry.size(), kLargestRegion);
  const std::int64_t width = kPlacesPerRow * kPageSide;
  auto texture =
      gpu::Texture2D::create(device, gpu::TexelFormat::r32f, width,
                             (most + kPlacesPerRow - 1) / kPlacesPerRow * kPageSide, "values to paint");
  if (!texture) return pass_on(texture);
  std::vector<float> texels(static_cast<std::size_t>(texture->width() * texture->height()));
  const gpu::BlendScope combined(blending);
  for (std::int64_t first = 0; first < geometry.size(); first += most) {
    const std::int64_t count = std::min(most, geometry.size() - first);
    for (std::int64_t i = 0; i < count; ++i) {
      const float* page = values.data() + (first + i) * kPageTexels;
      float* to = texels.data() + i / kPlacesPerRow * kPageSide * width + i % kPlacesPerRow * kPageSide;
      for (std::int64_t y = 0; y < kPageSide; ++y)
        std::copy_n(page + y * kPageSide, kPageSide, to + y * width);
    }
    texture->upload({0, 0, texture->width(), texture->height()}, std::as_bytes(std::span(texels)));
    use(paint_, memory);
    paint_.set("place_texel", 1.0F / glm::vec2(texture->width(), texture->height()));
    texture->bind(1);
    paint_.set("values", 1);
    draw_into_memory(paint_, geometry, {first, count}, memory, PhysicalMemory::Target::both);
  }
  return device.check("painting");
}

}  // namespace tidemark::solver
