// Speed functions made from settings, and their values, for tests.
#pragma once

#include <QtGlobal>
#include <random>

#include "level_sets.h"
#include "solver/speed/speed_registry.h"

namespace tidemark::test {

inline solver::SpeedSetting setting_of(const std::string& name, std::map<std::string, double> values = {}) {
  return {{solver::SpeedTerm{name, std::move(values)}}, solver::Combine::least};
}

// Before the cache: as the file of the function computes it.
inline std::shared_ptr<const solver::SpeedFunction> uncached(const solver::SpeedInputs& inputs,
                                                             const std::string& name,
                                                             std::map<std::string, double> values = {}) {
  const solver::SpeedKind& kind = *solver::speed_kind(name);
  for (const auto& number : kind.parameters) values.try_emplace(number.name, number.initial);
  auto made = kind.make(inputs, values, {});
  if (!made) qFatal("%s", made.error().message.c_str());
  return std::move(*made);
}

inline std::vector<double> speeds(const solver::SpeedFunction& function, const solver::VoxelBox& box) {
  std::vector<double> values(static_cast<std::size_t>(box.voxels()));
  function.evaluate(box, values.data());
  return values;
}

inline std::vector<glm::vec3> velocities(const solver::SpeedFunction& function, const solver::VoxelBox& box) {
  std::vector<glm::vec3> values(static_cast<std::size_t>(box.voxels()));
  function.evaluate_advection(box, values.data());
  return values;
}

inline double speed_at(const solver::SpeedFunction& function, Index3 voxel) {
  return speeds(function, {voxel, Index3(1)}).front();
}

// Whether D and v have the same bits in random boxes as in one box of the whole grid.
inline bool same_in_every_box(const solver::SpeedFunction& function, Index3 grid) {
  std::mt19937 random(11);
  const auto whole = speeds(function, {Index3(0), grid});
  const auto flow = velocities(function, {Index3(0), grid});
  for (int i = 0; i < 60; ++i) {
    solver::VoxelBox box;
    for (int axis = 0; axis < 3; ++axis) {
      box.first[axis] = std::uniform_int_distribution<std::int64_t>(0, grid[axis] - 1)(random);
      box.size[axis] = std::uniform_int_distribution<std::int64_t>(1, grid[axis] - box.first[axis])(random);
    }
    const auto part = speeds(function, box);
    const auto part_flow = velocities(function, box);
    for (std::int64_t n = 0; n < box.voxels(); ++n) {
      const Index3 v =
          box.first + Index3(n % box.size.x, n / box.size.x % box.size.y, n / (box.size.x * box.size.y));
      const auto at = static_cast<std::size_t>(v.x + grid.x * (v.y + grid.y * v.z));
      const auto in_part = static_cast<std::size_t>(n);
      if (part[in_part] != whole[at] || part_flow[in_part] != flow[at]) return false;
    }
  }
  return true;
}

// Noise that is the same in every run, with that standard deviation.
inline std::shared_ptr<const Volume> with_noise(const std::shared_ptr<const Volume>& volume,
                                                double deviation) {
  auto noisy = std::make_shared<Volume>(*volume);
  std::mt19937 random(3);
  for (float& value : std::get<std::vector<float>>(noisy->voxels)) {
    double sum = -6.0;  // of twelve uniform numbers, since std::normal_distribution differs between libraries
    for (int i = 0; i < 12; ++i) sum += static_cast<double>(random()) / 4294967296.0;
    value += static_cast<float>(deviation * sum);
  }
  return noisy;
}

}  // namespace tidemark::test
