#include "solver/gl/speed_textures.h"

#include <algorithm>
#include <glm/common.hpp>

#include "core/without_exceptions.h"
#include "solver/speed/cached_speed.h"

namespace tidemark::solver {
namespace {

constexpr std::int64_t kLongestRun = 8;  // blocks, as in CachedSpeed
// Evaluated before they are written: bounds the memory on the way.
constexpr std::size_t kRunsAtATime = 512;

}  // namespace

struct SpeedTextures::Run {
  VoxelBox box;
  std::vector<std::int16_t> speed;
  std::vector<glm::vec4> velocity;
};

Result<SpeedTextures> SpeedTextures::create(gpu::Device& device, Index3 volume_size, int threads,
                                            bool velocity) {
  auto speed = gpu::Texture3D::create(device, gpu::TexelFormat::r16i, volume_size, {}, "D");
  if (!speed) return pass_on(speed);
  SpeedTextures textures;
  textures.blocks_ = PageLayout(volume_size, kDefaultPageShape);
  textures.threads_ = std::make_shared<ThreadPool>(threads);
  textures.speed_ = std::move(*speed);
  textures.wants_velocity_ = velocity;
  return textures;
}

std::int64_t SpeedTextures::bytes_for(Index3 volume_size, bool velocity) {
  const auto voxel = static_cast<std::int64_t>(sizeof(std::int16_t) + (velocity ? sizeof(glm::vec4) : 0));
  return volume_size.x * volume_size.y * volume_size.z * voxel;
}

Status SpeedTextures::set_function(gpu::Device& device, std::shared_ptr<const SpeedFunction> function) {
  if (function == function_) return {};
  const bool advects = wants_velocity_ && function->advects();
  if (advects != has_velocity_) {
    gpu::Texture3D velocity;
    if (advects) {
      auto made =
          gpu::Texture3D::create(device, gpu::TexelFormat::rgba32f, blocks_.domain_size(), {}, "velocity");
      if (!made) return pass_on(made);
      velocity = std::move(*made);
    }
    velocity_ = std::move(velocity);
    has_velocity_ = advects;
  }
  function_ = std::move(function);
  forget();
  return {};
}

void SpeedTextures::forget() {
  there_.assign(static_cast<std::size_t>(blocks_.page_count()), false);
  wanted_.clear();
  surrounded_.clear();
}

void SpeedTextures::want(const VoxelBox& box) {
  const Index3 first = box.first / kDefaultPageShape;
  const Index3 last = (box.first + box.size - Index3(1)) / kDefaultPageShape;
  for (std::int64_t z = first.z; z <= last.z; ++z) {
    for (std::int64_t y = first.y; y <= last.y; ++y) {
      for (std::int64_t x = first.x; x <= last.x; ++x) {
        const std::int64_t block = blocks_.page_number({x, y, z});
        if (there_[static_cast<std::size_t>(block)]) continue;
        there_[static_cast<std::size_t>(block)] = true;
        wanted_.push_back(block);
      }
    }
  }
}

void SpeedTextures::want_around(const PageLayout& layout, std::span<const std::int64_t> pages, Index3 reach) {
  surrounded_.resize(static_cast<std::size_t>(layout.page_count()));
  for (const std::int64_t page : pages) {
    if (surrounded_[static_cast<std::size_t>(page)]) continue;
    surrounded_[static_cast<std::size_t>(page)] = true;
    const Index3 coordinates = layout.page_coordinates(page);
    const Index3 low = glm::max(coordinates - reach, Index3(0)) * layout.page_shape();
    const Index3 high =
        glm::min((coordinates + reach + Index3(1)) * layout.page_shape(), layout.domain_size());
    want({low, high - low});
  }
}

std::vector<SpeedTextures::Run> SpeedTextures::take_wanted() {
  std::sort(wanted_.begin(), wanted_.end());
  std::vector<Run> runs;
  std::int64_t length = 0;
  for (std::size_t i = 0; i < wanted_.size(); ++i) {
    const Index3 first = blocks_.first_voxel(wanted_[i]);
    const Index3 valid = blocks_.valid_shape(wanted_[i]);
    const bool follows = i > 0 && wanted_[i] == wanted_[i - 1] + 1 && first.x != 0 && length < kLongestRun;
    if (follows) {
      runs.back().box.size.x += valid.x;
      ++length;
    } else {
      runs.push_back({{first, valid}, {}, {}});
      length = 1;
    }
  }
  wanted_.clear();
  return runs;
}

void SpeedTextures::evaluate(std::span<Run> runs) const {
  threads_->for_each(std::ssize(runs), 1, [&](std::int64_t begin, std::int64_t end, int) {
    std::vector<glm::vec3> velocity;
    for (std::int64_t i = begin; i < end; ++i) {
      Run& run = runs[static_cast<std::size_t>(i)];
      run.speed.resize(static_cast<std::size_t>(run.box.voxels()));
      evaluate_quantised(*function_, run.box, run.speed.data());
      if (!has_velocity_) continue;
      velocity.resize(run.speed.size());
      function_->evaluate_advection(run.box, velocity.data());
      run.velocity.resize(run.speed.size());
      std::transform(velocity.begin(), velocity.end(), run.velocity.begin(),
                     [](glm::vec3 v) { return glm::vec4(v, 0.0F); });
    }
  });
}

Status SpeedTextures::fill(gpu::Device& device) {
  if (wanted_.empty()) return {};
  Status filled = without_exceptions([&] { return write(device, take_wanted()); });
  if (!filled) forget();
  return filled;
}

Status SpeedTextures::write(gpu::Device& device, std::vector<Run> runs) {
  for (std::size_t first = 0; first < runs.size(); first += kRunsAtATime) {
    const std::span<Run> some = std::span(runs).subspan(first, std::min(kRunsAtATime, runs.size() - first));
    evaluate(some);
    for (Run& run : some) {
      speed_.upload(run.box.first, run.box.size, std::as_bytes(std::span(run.speed)));
      if (has_velocity_)
        velocity_.upload(run.box.first, run.box.size, std::as_bytes(std::span(run.velocity)));
      run = {};
    }
  }
  return device.check("writing the speed of the surface");
}

gpu::Defines SpeedTextures::defines() const {
  gpu::Defines defines = {{"SPEED_VOLUME", ""}};
  if (has_velocity_) defines.emplace_back("ADVECTION", "");
  return defines;
}

void SpeedTextures::set_uniforms(const gpu::Program& program, int unit) const {
  speed_.bind(static_cast<unsigned>(unit));
  program.set("speed_volume", unit);
  if (!has_velocity_) return;
  velocity_.bind(static_cast<unsigned>(unit + 1));
  program.set("velocity_volume", unit + 1);
}

}  // namespace tidemark::solver
