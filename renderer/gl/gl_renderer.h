// Pictures drawn by OpenGL 3.3 from the packed pages.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "gpu/device.h"
#include "gpu/sampler_slots.h"
#include "renderer/gl/canvas.h"
#include "renderer/gl/evaluated_maps.h"
#include "renderer/gl/label_picture.h"
#include "renderer/gl/phi_picture.h"
#include "renderer/gl/slice_caster.h"
#include "renderer/gl/source_picture.h"
#include "renderer/quality_control.h"
#include "renderer/renderer.h"
#include "solver/gl/constraint_texture.h"
#include "solver/model.h"

namespace tidemark::renderer {

class GlRenderer final : public Renderer {
 public:
  // Pictures of level sets on `source` in pages of this layout. A source with more voxels along an axis than
  // the driver allows is never kept as a 3D texture: it is drawn from slices. Fails (ErrorKind::capability)
  // where the driver lacks what is needed.
  static Result<std::unique_ptr<GlRenderer>> create(std::shared_ptr<gpu::Device> device,
                                                    std::shared_ptr<const Volume> source,
                                                    const PageLayout& layout);

  [[nodiscard]] std::string_view name() const override { return "gl"; }
  [[nodiscard]] const Volume& source() const override { return *source_; }

  using Renderer::set_phi;
  Status set_phi(std::shared_ptr<const solver::Field> phi, std::span<const std::int64_t> quiet) override;
  // An executor's whose memory is on this device.
  Result<bool> look_at(solver::Executor& executor,
                       const std::optional<std::vector<std::int64_t>>& quiet) override;
  void set_parameters(const solver::Parameters& parameters) override;
  void set_speed(std::shared_ptr<const solver::SpeedFunction> speed) override {
    maps_.set_speed(std::move(speed));
  }
  void set_change(std::shared_ptr<const solver::SpeedFunction> change) override {
    maps_.set_change(std::move(change));
  }
  Status set_constraints(const solver::Constraints* constraints) override;
  Status set_labels(const PagedBytes& labels) override;
  Status set_label_colours(std::span<const LabelColour> colours) override;

  using Renderer::draw;
  Result<Picture> draw(const VolumeView& view, PictureSize size, const Progress& progress) override;
  Result<Picture> draw(const SliceView& view, PictureSize size, const Progress& progress) override;

  // The same onto a canvas (rgba8), at its size. Nothing is read back and nothing is waited for.
  Status draw_on(Canvas& canvas, const VolumeView& view, const Progress& progress = {});
  Status draw_on(Canvas& canvas, const SliceView& view, const Progress& progress = {});

  [[nodiscard]] int still_rounds() const override { return QualityControl::kRounds; }

  // Rays do not meet a source without a 3D texture.
  Result<std::optional<Hit>> pick(const VolumeView& view, PictureSize size, glm::dvec2 pixel) override;

  [[nodiscard]] const DrawReport& last_draw() const { return report_; }
  [[nodiscard]] std::int64_t pages_uploaded() const { return phi_.pages_uploaded(); }

 private:
  GlRenderer(std::shared_ptr<gpu::Device> device, std::shared_ptr<const Volume> source);
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
