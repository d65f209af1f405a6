// The drive of the surface as the solver's shaders read it: the source with the numbers of the tent, or D and
// a velocity; and walls and anchors.
#pragma once

#include <memory>
#include <optional>
#include <span>

#include "solver/gl/constraint_texture.h"
#include "solver/gl/speed_textures.h"
#include "solver/gl/step_uniforms.h"

namespace tidemark::solver {

class DriveTextures {
 public:
  DriveTextures() = default;
  // The tent on the source, without walls. Fails (ErrorKind::capability) when the volume is beyond the
  // driver's limit or its memory.
  static Result<DriveTextures> create(gpu::Device& device, const Volume& source,
                                      std::shared_ptr<const SpeedFunction> tent, int threads);

  // On failure (ErrorKind::capability) they are as before. The same function again changes nothing.
  Status set_speed(gpu::Device& device, std::shared_ptr<const SpeedFunction> speed);
  Status set_constraints(gpu::Device& device, const Constraints* constraints);

  // Of all but the source: what such a function and such walls take, or would take.
  [[nodiscard]] static std::int64_t bytes_for(Index3 volume_size, const SpeedFunction& speed,
                                              const Constraints* constraints);
  [[nodiscard]] std::int64_t bytes() const;

  // A run of steps must not be longer where the processor evaluates D: the surface moves less than a voxel a
  // step.
  static constexpr std::int64_t kMostStepsOfARun = 8;
  [[nodiscard]] bool is_evaluated() const { return speed_textures_.has_value(); }
  // Evaluates D around resident pages, as far as the surface comes in so many steps.
  Status fill_around(gpu::Device& device, const PageLayout& layout, std::span<const std::int64_t> pages,
                     std::int64_t steps);

  // The variant of the shaders; kUnits textures from `unit` on, and one for walls and anchors alone.
  static constexpr int kUnits = 4;
  [[nodiscard]] gpu::Defines defines() const;
  [[nodiscard]] gpu::Defines constraint_defines() const;
  void set_uniforms(const gpu::Program& program, int unit) const;
  void set_constraint_uniforms(const gpu::Program& program, int unit) const;

 private:
  SourceTexture source_;
  Index3 volume_size_{0};
  int threads_ = 0;
  std::shared_ptr<const SpeedFunction> speed_;
  std::optional<SpeedTextures> speed_textures_;  // of a function other than the tent
  std::optional<ConstraintTexture> constraints_;
};

}  // namespace tidemark::solver
