// Pictures of a study and its level set, drawn by OpenGL 3.3 from the packed pages (paper sections 5
// and 6.2).
#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "gpu/device.h"
#include "gpu/sampler_slots.h"
#include "renderer/canvas.h"
#include "renderer/evaluated_maps.h"
#include "renderer/label_picture.h"
#include "renderer/phi_picture.h"
#include "renderer/slice_caster.h"
#include "renderer/source_picture.h"
#include "renderer/views.h"
#include "solver/gl/constraint_texture.h"
#include "solver/model.h"

namespace tidemark::renderer {

// The first thing that a ray meets.
struct Hit {
  enum class Kind { clip_plane = 1, surface, source };  // as in render/volume.frag
  Kind kind = Kind::surface;
  glm::dvec3 voxel{0.0};       // voxel coordinates, integers at centres
  glm::dvec3 patient_mm{0.0};  // LPS
};

class Renderer {
 public:
  // Pictures of level sets on `source` in pages of this layout. A source with more than `largest_volume`
  // voxels along an axis, or more than the driver allows, is never kept as a 3D texture: it is drawn from
  // slices. Fails (ErrorKind::capability) where the driver lacks what is needed.
  static Result<std::unique_ptr<Renderer>> create(std::shared_ptr<gpu::Device> device,
                                                  std::shared_ptr<const Volume> source,
                                                  const solver::PageLayout& layout,
                                                  std::int64_t largest_volume = 1 << 30);

  // Shows phi from now on. `quiet`: virtual pages that are not computed at present. Fails (ErrorKind::usage)
  // unless phi has the layout and the grid of create().
  Status set_phi(const solver::Field& phi, std::span<const std::int64_t> quiet = {});
  // Draws from now on from the GPU memory of an executor on this device (Executor::packed_view()); to be
  // called again after each run of steps, and before any picture after another call to the executor. With
  // `quiet` (Executor::quiet_pages()) the page views are right, too. Fails (ErrorKind::usage) unless the
  // pages are those of create().
  Status look_at(const solver::PackedView& view,
                 const std::optional<std::vector<std::int64_t>>& quiet = std::nullopt);
  // The parameters of the speed map.
  void set_parameters(const solver::Parameters& parameters);
  // What drives the surface, for the speed map and its colours; null: the tent of the parameters. D is
  // evaluated where pictures show it.
  void set_speed(std::shared_ptr<const solver::SpeedFunction> speed) { maps_.set_speed(std::move(speed)); }
  // How far the surface has moved since it began, from -1 to 1 (solver::MotionLimit::change()); null: nobody
  // knows.
  void set_change(std::shared_ptr<const solver::SpeedFunction> change) {
    maps_.set_change(std::move(change));
  }
  // Walls and anchors, which slices show; null: none. Fails (ErrorKind::usage) when they are on another grid,
  // (ErrorKind::capability) when memory is short.
  Status set_constraints(const solver::Constraints* constraints);
  // A label for each voxel, 0 for none. Fails (ErrorKind::usage) when there are not as many as voxels.
  Status set_labels(std::span<const std::uint8_t> labels);
  // Red, green, blue and opacity (0: hidden) of the labels from 0 on; at first all are seen, with
  // label_colour(). Fails (ErrorKind::usage) on more than kLabels.
  static constexpr std::size_t kLabels = LabelPicture::kLabels;
  using LabelColour = LabelPicture::Colour;
  Status set_label_colours(std::span<const LabelColour> colours);

  // Fails (ErrorKind::cancelled) on a request to stop, (ErrorKind::capability) when the context is lost.
  Result<Picture> draw(const VolumeView& view, PictureSize size, const Progress& progress = {});
  Result<Picture> draw(const SliceView& view, PictureSize size, const Progress& progress = {});

  // The same onto a canvas (rgba8), at its size. Nothing is read back and nothing is waited for.
  Status draw_on(Canvas& canvas, const VolumeView& view, const Progress& progress = {});
  Status draw_on(Canvas& canvas, const SliceView& view, const Progress& progress = {});

  // The first thing at a pixel (from the picture's top left); none when nothing is seen. Rays do not meet a
  // source without a 3D texture.
  Result<std::optional<Hit>> pick(const VolumeView& view, PictureSize size, glm::dvec2 pixel);

  [[nodiscard]] const DrawReport& last_draw() const { return report_; }
  [[nodiscard]] std::int64_t pages_uploaded() const { return phi_.pages_uploaded(); }
  [[nodiscard]] const Volume& source() const { return *source_; }

 private:
  Renderer(std::shared_ptr<gpu::Device> device, std::shared_ptr<const Volume> source);
  // An existing program, or a new one. Beyond a limit, the one unused for longest is deleted.
  Result<const gpu::Program*> find_program(const char* fragment, const gpu::Defines& variant);
  // A program with the uniforms that all programs have; the view's own are not set. `evaluated`: of the map
  // that it reads.
  Result<const gpu::Program*> use_program(const char* fragment, const gpu::Defines& variant,
                                          const SpeedPicture* evaluated = nullptr);
  Result<const gpu::Program*> use_volume_program(const char* fragment, const VolumeView& view,
                                                 PictureSize size, gpu::Defines variant);
  [[nodiscard]] VolumeView resolved(const VolumeView& asked);
  [[nodiscard]] bool shows_labels(const VolumeView& view) const;
  template <class View>
  Result<Picture> draw_and_read(const View& view, PictureSize size, const Progress& progress);
  Status draw_from_slices(Canvas& canvas, const VolumeView& view, const Progress& progress);
  Status fill(Canvas& canvas, const Progress& progress);

  std::shared_ptr<gpu::Device> device_;
  std::shared_ptr<const Volume> source_;
  gpu::SamplerSlots slots_;
  std::optional<std::pair<float, float>> common_range_;  // of the source, once it is needed
  solver::StepConstants<float> constants_;
  solver::Tent tent_;
  SourcePicture source_picture_;
  PhiPicture phi_;
  LabelPicture labels_;
  EvaluatedMaps maps_;
  std::optional<solver::ConstraintTexture> constraints_;
  struct Made {
    gpu::Program program;
    std::int64_t used = 0;
  };
  std::map<std::string, Made> programs_;  // by shader and variant, made when first needed
  std::int64_t uses_ = 0;
  SliceCaster slice_caster_;
  Canvas canvas_;
  Canvas pick_canvas_;
  DrawReport report_;
};

}  // namespace tidemark::renderer
