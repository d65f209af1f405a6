#include "renderer/gl/speed_picture.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace tidemark::renderer {

void SpeedPicture::set_function(std::shared_ptr<const solver::SpeedFunction> function) {
  function_ = std::move(function);
  if (!is_evaluated()) textures_ = solver::SpeedTextures(blocks_.domain_size(), 0, false);
}

gpu::Defines SpeedPicture::defines() const {
  return is_evaluated() ? textures_.defines() : gpu::Defines();
}

Status SpeedPicture::fill_plane(gpu::Device& device, const glm::dmat4& voxel_from_view) {
  if (!is_evaluated()) return {};
  TIDEMARK_TRY(textures_.set_function(device, function_));
  const glm::dvec3 middle(voxel_from_view[3]);
  const glm::dvec3 right(voxel_from_view[0]);
  const glm::dvec3 up(voxel_from_view[1]);
  const glm::dvec3 normal = glm::cross(right, up);
  // What is between voxels needs those on both sides.
  const glm::dvec3 reach = glm::abs(right) + glm::abs(up) + 1.0;
  const glm::dvec3 end(blocks_.domain_size() - Index3(1));
  const Index3 first = Index3(glm::clamp(glm::floor(middle - reach), glm::dvec3(0.0), end)) / Index3(8);
  const Index3 last = Index3(glm::clamp(glm::ceil(middle + reach), glm::dvec3(0.0), end)) / Index3(8);
  constexpr double kHalfBlock = 4.5;  // and the voxels before and behind it
  for (std::int64_t z = first.z; z <= last.z; ++z) {
    for (std::int64_t y = first.y; y <= last.y; ++y) {
      for (std::int64_t x = first.x; x <= last.x; ++x) {
        const Index3 voxel = Index3(x, y, z) * kDefaultPageShape;
        const double distance = glm::dot(normal, glm::dvec3(voxel) + 3.5 - middle);
        const glm::dvec3 extent = glm::abs(normal) * kHalfBlock;
        if (std::abs(distance) <= extent.x + extent.y + extent.z) textures_.wanted().want({voxel, Index3(1)});
      }
    }
  }
  return textures_.fill(device);
}

Status SpeedPicture::fill_pages(gpu::Device& device, const PageLayout& layout,
                                const std::vector<solver::PhysicalPage>& entries) {
  if (!is_evaluated()) return {};
  TIDEMARK_TRY(textures_.set_function(device, function_));
  std::vector<std::int64_t> pages;
  for (std::size_t page = 0; page < entries.size(); ++page) {
    if (entries[page] >= solver::kFirstPage) pages.push_back(static_cast<std::int64_t>(page));
  }
  textures_.wanted().want_around(layout, pages, Index3(0));
  return textures_.fill(device);
}

void SpeedPicture::set_uniforms(const gpu::Program& program, int unit) const {
  textures_.set_uniforms(program, unit);
}

}  // namespace tidemark::renderer
