// Mean and spread of the values under a drag of the mouse (paper section 6.2).
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <set>
#include <utility>

#include "core/volume.h"

namespace tidemark::engine {

// Each voxel counts once, however slowly the mouse goes.
class ValueProbe {
 public:
  explicit ValueProbe(std::shared_ptr<const Volume> volume) : volume_(std::move(volume)) {}

  // Adds the voxels within `radius_mm` of the way from `from` to `to` (LPS, mm).
  void add(glm::dvec3 from_mm, glm::dvec3 to_mm, double radius_mm);

  struct Spread {
    double mean = 0.0;
    double deviation = 0.0;  // standard deviation of the population
  };
  [[nodiscard]] std::int64_t count() const { return static_cast<std::int64_t>(seen_.size()); }
  [[nodiscard]] Spread values() const { return spread(value_); }        // the volume's units
  [[nodiscard]] Spread gradients() const { return spread(gradient_); }  // magnitude, units a mm

 private:
  // Sums by Welford: no loss of digits for large values of small spread.
  struct Sums {
    double mean = 0.0;
    double squares = 0.0;
  };
  void add(Index3 voxel);
  void count_in(Sums& sums, double value) const;
  [[nodiscard]] Spread spread(const Sums& sums) const;

  std::shared_ptr<const Volume> volume_;
  std::set<std::int64_t> seen_;
  Sums value_;
  Sums gradient_;
};

// The smallest epsilon that a probe may set: a hundredth of the range of common values. A smaller one, from
// an even patch, would exclude everything else.
double least_probed_range(double common_low, double common_high);

}  // namespace tidemark::engine
