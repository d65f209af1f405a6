#include "solver/box_distances.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/gtx/component_wise.hpp>
#include <limits>

namespace tidemark::solver {
namespace {

constexpr float kInfinite = std::numeric_limits<float>::infinity();

// The rows never overlap, which lets compilers make vectors of them.
void lower(float* __restrict to, const float* __restrict from, float cost, std::int64_t length) {
  for (std::int64_t x = 0; x < length; ++x) to[x] = std::min(to[x], from[x] + cost);
}

}  // namespace

BandReach::BandReach(const Geometry& geometry, double band) {
  const glm::dvec3 spacing = geometry.spacing_mm / glm::compMin(geometry.spacing_mm);
  for (int axis = 0; axis < 3; ++axis) {
    // Beyond the grid there is nothing to reach.
    const double farthest = static_cast<double>(geometry.size[axis]);
    voxels[axis] = static_cast<std::int64_t>(std::min(std::ceil(band / spacing[axis] + 0.5), farthest));
    std::vector<float>& steps_cost = costs[static_cast<std::size_t>(axis)];
    steps_cost.push_back(0.0F);
    for (std::int64_t steps = 1; steps <= voxels[axis]; ++steps) {
      const double distance = (static_cast<double>(steps) - 0.5) * spacing[axis];
      steps_cost.push_back(static_cast<float>(distance * distance));
    }
    steps_cost.push_back(kInfinite);
  }
}

std::span<const float> BoxDistances::compute(const Inside& inside, Index3 first, Index3 size, float limit) {
  first_ = first;
  size_ = size;
  before_ = glm::min(first, reach_.voxels);
  around_ = glm::min(first + size + reach_.voxels, inside.geometry.size) - first + before_;
  read(inside);
  result_.resize(static_cast<std::size_t>(size.x * size.y * size.z));
  for (const Side side : {Side::outside, Side::inside}) {
    least_along_x(side);
    least_along(1, along_x_, along_y_);
    least_along(2, along_y_, along_z_);
    take(side, limit);
  }
  return result_;
}

void BoxDistances::read(const Inside& inside) {
  voxels_.resize(static_cast<std::size_t>(around_.x * around_.y * around_.z));
  std::uint8_t* row = voxels_.data();
  const Index3 corner = first_ - before_;
  for (std::int64_t z = 0; z < around_.z; ++z) {
    for (std::int64_t y = 0; y < around_.y; ++y, row += around_.x) {
      inside.read(inside.geometry.offset(corner + Index3(0, y, z)),
                  {row, static_cast<std::size_t>(around_.x)});
    }
  }
}

void BoxDistances::least_along_x(Side side) {
  const auto wanted = static_cast<std::uint8_t>(side);
  const std::int64_t rows = around_.y * around_.z;
  along_x_.make_room(size_.x, rows);
  for (std::int64_t row = 0; row < rows; ++row) {
    const std::uint8_t* const voxels = voxels_.data() + row * around_.x;
    const auto found = std::count(voxels, voxels + around_.x, wanted);
    float* const to = along_x_.row(row);
    along_x_.reached[static_cast<std::size_t>(row)] = found != 0;
    if (found == around_.x) {
      std::fill_n(to, size_.x, 0.0F);
    } else if (found != 0) {
      least_along_row(voxels, wanted, to);
    }
  }
}

void BoxDistances::least_along_row(const std::uint8_t* voxels, std::uint8_t wanted, float* to) const {
  const std::vector<float>& costs = reach_.costs[0];
  const std::size_t none = costs.size() - 1;
  std::size_t steps = none;
  const auto next = [&](std::int64_t x) {
    steps = voxels[x] == wanted ? 0 : std::min(steps + 1, none);
    return costs[steps];
  };
  const std::int64_t end = before_.x + size_.x;
  for (std::int64_t x = 0; x < before_.x; ++x) next(x);
  for (std::int64_t x = before_.x; x < end; ++x) to[x - before_.x] = next(x);
  steps = none;
  for (std::int64_t x = around_.x - 1; x >= end; --x) next(x);
  for (std::int64_t x = end - 1; x >= before_.x; --x) {
    to[x - before_.x] = std::min(to[x - before_.x], next(x));
  }
}

// Rows of `from` cover the surroundings along the axis and those after it; rows of `to` the box along it.
void BoxDistances::least_along(int axis, const Rows& from, Rows& to) const {
  const std::int64_t reach = reach_.voxels[axis];
  const std::int64_t stride = axis == 1 ? 1 : size_.y;    // between neighbours along the axis
  const std::int64_t planes = axis == 1 ? around_.z : 1;  // sets of rows that do not meet
  const std::int64_t length = around_[axis];
  to.make_room(size_.x, planes * size_[axis] * stride);
  std::int64_t made = 0;
  for (std::int64_t plane = 0; plane < planes; ++plane) {
    for (std::int64_t place = before_[axis]; place < before_[axis] + size_[axis]; ++place) {
      const std::int64_t low = std::max<std::int64_t>(place - reach, 0);
      const std::int64_t high = std::min(place + reach, length - 1);
      for (std::int64_t beside = 0; beside < stride; ++beside, ++made) {
        const std::int64_t first = (plane * length + low) * stride + beside;
        to.take_least(made, from, first, stride, &reach_.costs[static_cast<std::size_t>(axis)][0],
                      low - place, high - place);
      }
    }
  }
}

// The least of rows of `from`, of which the first is `low` steps away, the last `high`.
void BoxDistances::Rows::take_least(std::int64_t number, const Rows& from, std::int64_t first,
                                    std::int64_t stride, const float* costs, std::int64_t low,
                                    std::int64_t high) {
  float* const to = row(number);
  std::fill_n(to, width, kInfinite);
  bool any = false;
  for (std::int64_t steps = low; steps <= high; ++steps) {
    const std::int64_t source = first + (steps - low) * stride;
    if (from.reached[static_cast<std::size_t>(source)] == 0) continue;
    any = true;
    lower(to, from.row(source), costs[std::abs(steps)], width / kLanes * kLanes);
  }
  reached[static_cast<std::size_t>(number)] = any;
}

// Each voxel has its distance to the nearest one of the other side.
void BoxDistances::take(Side to_side, float limit) {
  const auto own = static_cast<std::uint8_t>(to_side == Side::inside ? Side::outside : Side::inside);
  const float sign = to_side == Side::inside ? -1.0F : 1.0F;
  std::int64_t row = 0;
  for (std::int64_t z = 0; z < size_.z; ++z) {
    for (std::int64_t y = 0; y < size_.y; ++y, ++row) {
      const std::uint8_t* const voxels = voxels_.data() + number_in(around_, before_ + Index3(0, y, z));
      const float* const squared = along_z_.row(row);
      const bool reached = along_z_.reached[static_cast<std::size_t>(row)] != 0;
      float* const to = result_.data() + row * size_.x;
      for (std::int64_t x = 0; x < size_.x; ++x) {
        if (voxels[x] != own) continue;
        to[x] = sign * (reached ? std::min(std::sqrt(squared[x]), limit) : limit);
      }
    }
  }
}

}  // namespace tidemark::solver
