// Squared distances in a box of voxels to the nearest ones inside, and outside.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/geometry.h"
#include "core/inside.h"

namespace tidemark::solver {

// How far the band reaches along each axis, with what a step costs.
struct BandReach {
  BandReach(const Geometry& geometry, double band);

  Index3 voxels;
  // The squared distance along an axis, in units of the smallest spacing, from a voxel's centre to the
  // nearest point of the voxel that is as many steps away as the index says; infinite beyond the reach.
  std::array<std::vector<float>, 3> costs;
};

// The squared distance is separable: from a voxel's centre to the nearest of some voxels it is the least sum
// of the axes' squared distances. Each pass takes the least over one axis, no farther than the band reaches.
class BoxDistances {
 public:
  explicit BoxDistances(const BandReach& reach) : reach_(reach) {}

  // Clamped signed distances of the voxels of a box, x fastest, in units of the smallest spacing; > 0 inside.
  // They stay until the next call.
  std::span<const float> compute(const Inside& inside, Index3 first, Index3 size, float limit);

 private:
  enum class Side : std::uint8_t { outside, inside };
  // Rows along x as wide as the box, or a little wider, and which of them hold anything that is not infinite.
  // The others hold anything.
  struct Rows {
    static constexpr std::int64_t kLanes = 8;  // the width is a multiple of it: rows are computed in vectors

    void make_room(std::int64_t length, std::int64_t rows) {
      width = (length + kLanes - 1) / kLanes * kLanes;
      values.resize(static_cast<std::size_t>(width * rows));
      reached.resize(static_cast<std::size_t>(rows));
    }
    [[nodiscard]] float* row(std::int64_t number) { return values.data() + number * width; }
    [[nodiscard]] const float* row(std::int64_t number) const { return values.data() + number * width; }

    void take_least(std::int64_t number, const Rows& from, std::int64_t first, std::int64_t stride,
                    const float* costs, std::int64_t low, std::int64_t high);

    std::int64_t width = 0;
    std::vector<float> values;
    std::vector<std::uint8_t> reached;
  };

  void read(const Inside& inside);
  void least_along_x(Side side);
  void least_along_row(const std::uint8_t* voxels, std::uint8_t wanted, float* to) const;
  void least_along(int axis, const Rows& from, Rows& to) const;
  void take(Side to_side, float limit);

  const BandReach& reach_;
  Index3 first_{0};                   // of the box
  Index3 size_{0};                    // of the box
  Index3 before_{0};                  // voxels of the surroundings before the box
  Index3 around_{0};                  // size of the box with its surroundings
  std::vector<std::uint8_t> voxels_;  // of the box with its surroundings
  Rows along_x_, along_y_, along_z_;
  std::vector<float> result_;
};

}  // namespace tidemark::solver
