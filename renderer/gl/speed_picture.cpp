#include "renderer/gl/speed_picture.h"

#include "renderer/plane_blocks.h"

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
  for (const Index3 voxel : blocks_on_plane(blocks_, voxel_from_view))
    textures_.wanted().want({voxel, Index3(1)});
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
