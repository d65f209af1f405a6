// The drive of the surface as the solver's shaders read it: the source with the numbers of the tent, or D and
// a velocity; and walls and anchors.
#pragma once

#include <memory>
#include <optional>
#include <span>

#include "solver/gl/constraint_texture.h"
#include "solver/gl/source_texture.h"
#include "solver/gl/speed_textures.h"
#include "solver/gl/step_uniforms.h"

namespace tidemark::solver {

class DriveTextures {
 public:
  DriveTextures() = default;
  // The tent on the source, without walls. Fails (ErrorKind::capability) when the driver's limits or its
  // memory are too small.
  static Result<DriveTextures> create(gpu::Device& device, std::shared_ptr<const Volume> source,
                                      std::shared_ptr<const SpeedFunction> tent, int threads);

  // On failure (ErrorKind::capability) they are as before. The same function again changes nothing.
  Status set_speed(gpu::Device& device, std::shared_ptr<const SpeedFunction> speed);
  Status set_constraints(gpu::Device& device, const Constraints* constraints);

  // Of all but a source in one texture: what is there, and the least that such a function and such walls take
  // on so many resident voxels.
  [[nodiscard]] std::int64_t bytes() const;
  [[nodiscard]] static std::int64_t least_bytes(std::int64_t resident_voxels, const SpeedFunction& speed,
                                                const Constraints* constraints);

  // Whether the processor fills what steps read: around resident pages, and as far as the surface comes in a
  // run, which must not be longer than that. The surface moves less than a voxel a step.
  [[nodiscard]] bool is_filled() const { return wanted() != nullptr; }
  static constexpr std::int64_t kMostStepsOfARun = 8;
  void want_around(const PageLayout& layout, std::span<const std::int64_t> pages, std::int64_t steps);
  // The least that bytes() are while fill() makes what is wanted; it takes more where that stays below
  // `most_bytes`. It fails (ErrorKind::capability) when memory is short.
  [[nodiscard]] std::int64_t bytes_wanted() const;
  Status fill(gpu::Device& device, std::int64_t most_bytes);
  // Nothing that is filled is there, and nothing is wanted: the memory goes back.
  Status release(gpu::Device& device);

  // The variant of the shaders; textures from `unit` on, and those of walls and anchors alone.
  [[nodiscard]] gpu::Defines defines() const;
  [[nodiscard]] gpu::Defines constraint_defines() const;
  void set_uniforms(const gpu::Program& program, int unit) const;
  void set_constraint_uniforms(const gpu::Program& program, int unit) const;

 private:
  // Null: nothing is filled.
  [[nodiscard]] FilledBlocks* wanted() {
    return speed_textures_ ? &speed_textures_->wanted() : source_.wanted();
  }
  [[nodiscard]] const FilledBlocks* wanted() const {
    return speed_textures_ ? &speed_textures_->wanted() : source_.wanted();
  }

  SourceTexture source_;
  Index3 volume_size_{0};
  int threads_ = 0;
  std::shared_ptr<const SpeedFunction> speed_;
  std::optional<SpeedTextures> speed_textures_;  // of a function other than the tent
  std::optional<ConstraintTexture> constraints_;
};

}  // namespace tidemark::solver
