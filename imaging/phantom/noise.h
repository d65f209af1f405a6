// Randomness that is the same on every machine: integer hashes of (seed, index), and arithmetic that rounds
// the same everywhere. The standard library's distributions and the C library's sine differ between systems.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

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
  // Wavelengths are uniform between shortest_mm and longest_mm; more waves look less regular.
  RandomWaves(std::uint64_t seed, int waves, double shortest_mm, double longest_mm);

  struct Sample {
    double value;
    glm::dvec3 gradient;  // per mm
  };
  [[nodiscard]] Sample sample(const glm::dvec3& p_mm) const;
  [[nodiscard]] double value(const glm::dvec3& p_mm) const;

 private:
  struct Component {
    glm::dvec3 turns_per_mm;
    double phase;
  };
  std::vector<Component> components_;
  double amplitude_;
};

}  // namespace tidemark::imaging::phantom
