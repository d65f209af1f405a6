// Randomness that is the same on every machine: integer hashes of (seed, index), and arithmetic that rounds
// the same everywhere. The standard library's distributions and the C library's sine differ between systems.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>

namespace tidemark::imaging::phantom {

// A hash of (seed, index) with all 64 bits well mixed: random access, so that threads need no shared state.
[[nodiscard]] std::uint64_t hash(std::uint64_t seed, std::uint64_t index);

// Uniform in [0, 1).
[[nodiscard]] double uniform(std::uint64_t seed, std::uint64_t index);

// Mean 0, standard deviation 1, within +-4.9: the sum of eight uniform numbers.
[[nodiscard]] double gaussian(std::uint64_t seed, std::uint64_t index);

// sin(2 pi turns) and its derivative by turns, to 4e-6, from additions and products alone.
struct Wave {
  double value;
  double slope;
};
[[nodiscard]] Wave wave(double turns);

// A smooth random field: plane waves in random directions, mean 0, standard deviation 1.
class RandomWaves {
 public:
  // Up to kMost waves, the lengths of which are uniform between shortest_mm and longest_mm; more look less
  // regular.
  static constexpr std::size_t kMost = 16;
  RandomWaves(std::uint64_t seed, int waves, double shortest_mm, double longest_mm);

  struct Sample {
    double value;
    glm::dvec3 gradient;  // per mm
  };
  [[nodiscard]] Sample sample(const glm::dvec3& p_mm) const;
  [[nodiscard]] double value(const glm::dvec3& p_mm) const;

 private:
  [[nodiscard]] double turns(std::size_t wave, const glm::dvec3& p_mm) const {
    return x_[wave] * p_mm.x + y_[wave] * p_mm.y + z_[wave] * p_mm.z + phase_[wave];
  }

  std::array<double, kMost> x_{}, y_{}, z_{};  // turns per mm
  std::array<double, kMost> phase_{};          // turns at the origin
  std::size_t count_;
  double amplitude_;
};

}  // namespace tidemark::imaging::phantom
