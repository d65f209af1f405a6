#include "solver/gl/drive_textures.h"

#include <algorithm>
#include <utility>

namespace tidemark::solver {

Result<DriveTextures> DriveTextures::create(gpu::Device& device, std::shared_ptr<const Volume> source,
                                            std::shared_ptr<const SpeedFunction> tent, int threads) {
  DriveTextures textures;
  textures.volume_size_ = source->geometry.size;
  auto texture = SourceTexture::create(device, std::move(source), threads);
  if (!texture) return pass_on(texture);
  textures.source_ = std::move(*texture);
  textures.threads_ = threads;
  textures.speed_ = std::move(tent);
  return textures;
}

std::int64_t DriveTextures::least_bytes(std::int64_t resident_voxels, const SpeedFunction& speed,
                                        const Constraints* constraints) {
  std::int64_t bytes = 0;
  if (speed.tent() == nullptr) bytes += resident_voxels * SpeedTextures::bytes_per_voxel(speed);
  if (constraints != nullptr) bytes += constraints->pages().stored() * Constraints::kPageVoxels;
  return bytes;
}

std::int64_t DriveTextures::bytes() const {
  return (source_.wanted() != nullptr ? source_.wanted()->bytes() : 0) +
         (speed_textures_ ? speed_textures_->wanted().bytes() : 0) +
         (constraints_ ? constraints_->bytes() : 0);
}

std::int64_t DriveTextures::bytes_wanted() const {
  return bytes() + (is_filled() ? wanted()->bytes_wanted() - wanted()->bytes() : 0);
}

Status DriveTextures::set_speed(gpu::Device& device, std::shared_ptr<const SpeedFunction> speed) {
  if (speed->tent() != nullptr) {
    speed_textures_.reset();
  } else if (speed_textures_) {
    TIDEMARK_TRY(speed_textures_->set_function(device, speed));
  } else {
    SpeedTextures made(volume_size_, threads_);
    TIDEMARK_TRY(made.set_function(device, speed));
    speed_textures_ = std::move(made);
  }
  speed_ = std::move(speed);
  // Nobody reads the source's blocks while there is D.
  if (speed_textures_ && source_.wanted() != nullptr) TIDEMARK_TRY(source_.wanted()->release(device));
  return {};
}

Status DriveTextures::set_constraints(gpu::Device& device, const Constraints* constraints) {
  if (constraints == nullptr || constraints->empty()) {
    constraints_.reset();
    return {};
  }
  if (!constraints_) {
    auto made = ConstraintTexture::create(device, volume_size_);
    if (!made) return pass_on(made);
    constraints_ = std::move(*made);
  }
  return constraints_->show(device, *constraints);
}

void DriveTextures::want_around(const PageLayout& layout, std::span<const std::int64_t> pages,
                                std::int64_t steps) {
  if (!is_filled()) return;
  wanted()->want_around(layout, pages,
                        (Index3(steps) + layout.page_shape() - Index3(1)) / layout.page_shape());
}

Status DriveTextures::fill(gpu::Device& device, std::int64_t most_bytes) {
  if (!is_filled()) return {};
  const std::int64_t most = most_bytes - (bytes() - wanted()->bytes());
  return speed_textures_ ? speed_textures_->fill(device, most) : source_.fill(device, most);
}

Status DriveTextures::release(gpu::Device& device) {
  return is_filled() ? wanted()->release(device) : Status();
}

gpu::Defines DriveTextures::defines() const {
  gpu::Defines defines = speed_textures_ ? speed_textures_->defines() : source_.defines();
  gpu::add(defines, constraint_defines());
  return defines;
}

gpu::Defines DriveTextures::constraint_defines() const {
  return constraints_ ? constraints_->defines() : gpu::Defines();
}

void DriveTextures::set_uniforms(const gpu::Program& program, int unit) const {
  if (speed_textures_) {
    speed_textures_->set_uniforms(program, unit);
  } else {
    source_.set_uniforms(program, unit);
    set_tent_uniforms(program, *speed_->tent());
  }
  set_constraint_uniforms(program, unit + std::max(SpeedTextures::kUnits, SourceTexture::kUnits));
}

void DriveTextures::set_constraint_uniforms(const gpu::Program& program, int unit) const {
  if (constraints_) constraints_->set_uniforms(program, unit);
}

}  // namespace tidemark::solver
