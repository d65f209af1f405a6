// Pictures of a study and its level set, drawn by OpenGL 3.3 from the packed pages (paper sections 5
// and 6.2).
#pragma once

#include <cstdint>
#include <glm/vec4.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "gpu/draw.h"
#include "renderer/camera.h"
#include "renderer/transfer_function.h"
#include "renderer/view_data.h"
#include "solver/model.h"

namespace tidemark {

// 8 bits each of red, green, blue and opacity (255), rows from the top.
struct Picture {
  std::int64_t width = 0;
  std::int64_t height = 0;
  std::vector<std::uint8_t> pixels;
};

// Everything in the patient where normal . p > offset is hidden, and the plane shows the source. LPS, mm.
struct ClipPlane {
  glm::dvec3 normal{0.0, 1.0, 0.0};
  double offset_mm = 0.0;
};

enum class Region { everywhere, inside, outside };

struct VolumeView {
  Camera camera;
  std::optional<TransferFunction> source;  // none: the surface alone
  bool surface = true;
  glm::vec4 surface_colour{0.93F, 0.72F, 0.45F, 1.0F};  // and opacity
  Region region = Region::everywhere;                   // where the source shows
  std::optional<ClipPlane> clip;
  WindowLevel window;        // of the clip plane's picture
  double step_voxels = 0.5;  // along a ray, in the smallest voxels' units
  glm::vec3 background{0.07F, 0.08F, 0.10F};
};

enum class SliceContent { source, speed, pages };

struct SliceView {
  SlicePlane plane = SlicePlane::axial;
  glm::dvec3 position_mm{0.0};  // a point of the slice
  double zoom = 1.0;
  SliceContent content = SliceContent::source;
  WindowLevel window;
  bool nearest = false;
  bool surface = true;
  double line_pixels = 2.0;
  glm::vec3 background{0.0F};
};

class Renderer {
 public:
  // Fails (ErrorKind::capability) where the driver lacks what is needed. `phi` and `source` are on the same
  // grid.
  static Result<std::unique_ptr<Renderer>> create(std::shared_ptr<gpu::Device> device,
                                                  std::shared_ptr<const Volume> source, const Field& phi);

  // Takes a new phi of the same grid.
  Status set_phi(const Field& phi);

  Result<Picture> draw(const VolumeView& view, std::int64_t width, std::int64_t height);
  Result<Picture> draw(const SliceView& view, const Parameters& parameters, std::int64_t width,
                       std::int64_t height);

 private:
  Renderer(std::shared_ptr<gpu::Device> device, std::shared_ptr<const Volume> source);
  Result<Picture> finish(std::int64_t width, std::int64_t height);

  std::shared_ptr<gpu::Device> device_;
  std::shared_ptr<const Volume> source_;
  SourcePicture source_picture_;
  PhiPicture phi_picture_;
  gpu::VertexArray vertices_;
  gpu::Program volume_;
  gpu::Program slice_;
  gpu::Texture2D target_;
};

}  // namespace tidemark
