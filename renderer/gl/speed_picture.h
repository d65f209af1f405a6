// D of a speed function for pictures: evaluated where a picture shows it.
#pragma once

#include <glm/mat4x4.hpp>
#include <memory>
#include <vector>

#include "solver/gl/speed_textures.h"
#include "solver/paging/page_table.h"

namespace tidemark::renderer {

class SpeedPicture {
 public:
  SpeedPicture() = default;
  explicit SpeedPicture(Index3 volume_size)
      : blocks_(volume_size, kDefaultPageShape), textures_(volume_size, 0, false) {}

  // Null, or a tent: pictures compute D from the source. Memory is taken when a picture first shows it.
  void set_function(std::shared_ptr<const solver::SpeedFunction> function);
  // The tent, if that is what drives the surface.
  [[nodiscard]] const solver::Tent* tent() const { return function_ ? function_->tent() : nullptr; }
  // Whether pictures read D from here.
  [[nodiscard]] bool is_evaluated() const { return function_ != nullptr && tent() == nullptr; }
  [[nodiscard]] gpu::Defines defines() const;

  // Evaluates D around the plane of a slice picture, or in the resident pages. They fail
  // (ErrorKind::capability) when memory is short. From the view (x and y in -1..1) to voxel coordinates.
  Status fill_plane(gpu::Device& device, const glm::dmat4& voxel_from_view);
  Status fill_pages(gpu::Device& device, const PageLayout& layout,
                    const std::vector<solver::PhysicalPage>& entries);

  void set_uniforms(const gpu::Program& program, int unit) const;

 private:
  PageLayout blocks_;
  std::shared_ptr<const solver::SpeedFunction> function_;
  solver::SpeedTextures textures_;
};

}  // namespace tidemark::renderer
