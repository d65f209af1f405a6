#include "solver/gl/drive_textures.h"

namespace tidemark::solver {

Result<DriveTextures> DriveTextures::create(gpu::Device& device, const Volume& source,
                                            std::shared_ptr<const SpeedFunction> tent, int threads) {
  auto texture = SourceTexture::create(device, source);
  if (!texture) return pass_on(texture);
  DriveTextures textures;
  textures.source_ = std::move(*texture);
  textures.volume_size_ = source.geometry.size;
  textures.threads_ = threads;
  textures.speed_ = std::move(tent);
  return textures;
}

std::int64_t DriveTextures::bytes_for(Index3 volume_size, const SpeedFunction& speed,
                                      const Constraints* constraints) {
  std::int64_t bytes = 0;
  if (speed.tent() == nullptr) bytes += SpeedTextures::bytes_for(volume_size, speed.advects());
  if (constraints != nullptr && !constraints->empty()) bytes += volume_size.x * volume_size.y * volume_size.z;
  return bytes;
}

std::int64_t DriveTextures::bytes() const {
  if (speed_ == nullptr) return 0;
  const std::int64_t walls = constraints_ ? volume_size_.x * volume_size_.y * volume_size_.z : 0;
  return walls + bytes_for(volume_size_, *speed_, nullptr);
}

Status DriveTextures::set_speed(gpu::Device& device, std::shared_ptr<const SpeedFunction> speed) {
  if (speed->tent() != nullptr) {
    speed_textures_.reset();
  } else if (speed_textures_) {
    TIDEMARK_TRY(speed_textures_->set_function(device, speed));
  } else {
    auto made = SpeedTextures::create(device, volume_size_, threads_);
    if (!made) return pass_on(made);
    TIDEMARK_TRY(made->set_function(device, speed));
    speed_textures_ = std::move(*made);
  }
  speed_ = std::move(speed);
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
  constraints_->show(*constraints);
  return {};
}

Status DriveTextures::fill_around(gpu::Device& device, const PageLayout& layout,
                                  std::span<const std::int64_t> pages, std::int64_t steps) {
  if (!speed_textures_) return {};
  const Index3 reach = (Index3(steps) + layout.page_shape() - Index3(1)) / layout.page_shape();
  speed_textures_->want_around(layout, pages, reach);
  return speed_textures_->fill(device);
}

gpu::Defines DriveTextures::defines() const {
  gpu::Defines defines = source_.defines();
  const auto append = [&](const gpu::Defines& more) {
    defines.insert(defines.end(), more.begin(), more.end());
  };
  if (speed_textures_) append(speed_textures_->defines());
  append(constraint_defines());
  return defines;
}

gpu::Defines DriveTextures::constraint_defines() const {
  return constraints_ ? constraints_->defines() : gpu::Defines();
}

void DriveTextures::set_uniforms(const gpu::Program& program, int unit) const {
  if (speed_textures_) {
    speed_textures_->set_uniforms(program, unit + 1);
  } else {
    source_.set_uniforms(program, unit);
    set_tent_uniforms(program, *speed_->tent());
  }
  set_constraint_uniforms(program, unit + 3);
}

void DriveTextures::set_constraint_uniforms(const gpu::Program& program, int unit) const {
  if (constraints_) constraints_->set_uniforms(program, unit);
}

}  // namespace tidemark::solver
