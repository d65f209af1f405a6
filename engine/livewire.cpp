#include "engine/livewire.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace tidemark::engine {
namespace {

constexpr float kLeastResistance = 0.02F;  // a detour of 50 voxels along an edge is worth one voxel beside it
constexpr double kEdges = 0.95;            // the share of voxels that are no edges
constexpr float kSteepness = 3.0F;         // an edge of that share resists a tenth of what flat voxels do

}  // namespace

Livewire::Livewire(SliceSlab slab, std::shared_ptr<const Volume> source)
    : slab_(slab), source_(std::move(source)) {}

void Livewire::begin_at(glm::dvec3 place_mm) {
  const Index3& size = slab_.geometry().size;
  const std::int64_t columns = size[slab_.axes()[0]];
  const std::int64_t rows = size[slab_.axes()[1]];
  const glm::dvec2 place = slab_.column_of(place_mm);
  const std::int64_t u = std::clamp<std::int64_t>(std::llround(place.x), 0, columns - 1);
  const std::int64_t v = std::clamp<std::int64_t>(std::llround(place.y), 0, rows - 1);
  low_u_ = std::max<std::int64_t>(u - kReach, 0);
  low_v_ = std::max<std::int64_t>(v - kReach, 0);
  width_ = std::min(u + kReach + 1, columns) - low_u_;
  height_ = std::min(v + kReach + 1, rows) - low_v_;
  find_resistances();
  const auto voxels = static_cast<std::size_t>(width_ * height_);
  costs_.assign(voxels, std::numeric_limits<double>::infinity());
  before_.assign(voxels, -1);
  is_final_.assign(voxels, false);
  open_ = {};
  costs_[static_cast<std::size_t>(at(u, v))] = 0.0;
  open_.push({0.0, at(u, v)});
}

// NaN where the plane leaves the grid.
std::vector<float> Livewire::values() const {
  std::vector<float> values;
  values.reserve(static_cast<std::size_t>(width_ * height_));
  for (std::int64_t v = low_v_; v < low_v_ + height_; ++v) {
    for (std::int64_t u = low_u_; u < low_u_ + width_; ++u) {
      const auto voxel = slab_.voxel_of(u, v);
      values.push_back(voxel ? source_->value(*voxel) : std::numeric_limits<float>::quiet_NaN());
    }
  }
  return values;
}

// By the gradient in the slice, in units of what is steep here: windows and modalities differ.
void Livewire::find_resistances() {
  const std::vector<float> value = values();
  const glm::dvec3& spacing = slab_.geometry().spacing_mm;
  const auto per_u = static_cast<float>(0.5 * slab_.finest_mm() / spacing[slab_.axes()[0]]);
  const auto per_v = static_cast<float>(0.5 * slab_.finest_mm() / spacing[slab_.axes()[1]]);
  const auto difference = [&](std::int64_t from, std::int64_t to) {
    const float slope = value[static_cast<std::size_t>(to)] - value[static_cast<std::size_t>(from)];
    return std::isnan(slope) ? 0.0F : slope;
  };
  std::vector<float> steepness(value.size());
  for (std::int64_t row = 0; row < height_; ++row) {
    for (std::int64_t column = 0; column < width_; ++column) {
      const std::int64_t here = row * width_ + column;
      const float along_u =
          difference(here - (column > 0 ? 1 : 0), here + (column + 1 < width_ ? 1 : 0)) * per_u;
      const float along_v =
          difference(here - (row > 0 ? width_ : 0), here + (row + 1 < height_ ? width_ : 0)) * per_v;
      steepness[static_cast<std::size_t>(here)] = std::hypot(along_u, along_v);
    }
  }
  std::vector<float> sorted = steepness;
  const auto steep =
      sorted.begin() + static_cast<std::ptrdiff_t>(kEdges * static_cast<double>(sorted.size() - 1));
  std::nth_element(sorted.begin(), steep, sorted.end());
  const float unit = std::max(*steep / kSteepness, std::numeric_limits<float>::min());
  resistances_ = std::move(steepness);
  for (float& resistance : resistances_) {
    const float in_units = resistance / unit;
    resistance = kLeastResistance + 1.0F / (1.0F + in_units * in_units);
  }
}

// Dijkstra's, as far as the target; it goes on from there the next time.
void Livewire::search(std::int64_t target) {
  const glm::dvec3& spacing = slab_.geometry().spacing_mm;
  const double per_u = spacing[slab_.axes()[0]] / slab_.finest_mm();
  const double per_v = spacing[slab_.axes()[1]] / slab_.finest_mm();
  const double across = std::hypot(per_u, per_v);
  struct Neighbour {
    std::int64_t u;
    std::int64_t v;
    double length;
  };
  const std::array<Neighbour, 8> neighbours{{{-1, 0, per_u},
                                             {1, 0, per_u},
                                             {0, -1, per_v},
                                             {0, 1, per_v},
                                             {-1, -1, across},
                                             {1, -1, across},
                                             {-1, 1, across},
                                             {1, 1, across}}};
  while (!is_final_[static_cast<std::size_t>(target)] && !open_.empty()) {
    const Step step = open_.top();
    open_.pop();
    const auto here = static_cast<std::size_t>(step.voxel);
    if (is_final_[here]) continue;
    is_final_[here] = true;
    const std::int64_t column = step.voxel % width_;
    const std::int64_t row = step.voxel / width_;
    for (const Neighbour& way : neighbours) {
      if (column + way.u < 0 || column + way.u >= width_ || row + way.v < 0 || row + way.v >= height_)
        continue;
      const std::int64_t next = step.voxel + way.v * width_ + way.u;
      const auto there = static_cast<std::size_t>(next);
      const double cost = step.cost + way.length * 0.5 * (resistances_[here] + resistances_[there]);
      if (cost >= costs_[there]) continue;
      costs_[there] = cost;
      before_[there] = step.voxel;
      open_.push({cost, next});
    }
  }
}

std::vector<glm::dvec3> Livewire::way_to(glm::dvec3 place_mm) {
  const glm::dvec2 place = slab_.column_of(place_mm);
  const std::int64_t u = std::clamp(std::int64_t{std::llround(place.x)}, low_u_, low_u_ + width_ - 1);
  const std::int64_t v = std::clamp(std::int64_t{std::llround(place.y)}, low_v_, low_v_ + height_ - 1);
  const std::int64_t target = at(u, v);
  search(target);
  std::vector<glm::dvec3> way{place_mm};
  // The voxel of the place itself would be a corner right beside it, as the first one would be.
  for (std::int64_t voxel = before_[static_cast<std::size_t>(target)];
       voxel >= 0 && before_[static_cast<std::size_t>(voxel)] >= 0;
       voxel = before_[static_cast<std::size_t>(voxel)])
    way.push_back(slab_.place_of({low_u_ + voxel % width_, low_v_ + voxel / width_}));
  std::reverse(way.begin(), way.end());
  return way;
}

}  // namespace tidemark::engine
