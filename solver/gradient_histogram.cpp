#include "solver/gradient_histogram.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtx/component_wise.hpp>
#include <optional>

#include "solver/page_with_apron.h"

namespace tidemark::solver {
namespace {

// Sums by Welford: no loss of digits.
class Counting {
 public:
  explicit Counting(double highest) : bins_per_unit_(GradientHistogram::kBins / highest) {}

  void add(double gradient) {
    const auto bin = static_cast<std::int64_t>(gradient * bins_per_unit_);
    const std::int64_t last = GradientHistogram::kBins - 1;
    ++part_.counts[static_cast<std::size_t>(std::min(bin, last))];
    ++part_.voxels;
    const double change = gradient - part_.mean;
    part_.mean += change / static_cast<double>(part_.voxels);
    squares_ += change * (gradient - part_.mean);
  }
  [[nodiscard]] GradientHistogram::Part part() const {
    GradientHistogram::Part part = part_;
    if (part.voxels > 0)
      part.deviation = std::sqrt(std::max(squares_, 0.0) / static_cast<double>(part.voxels));
    return part;
  }

 private:
  double bins_per_unit_;
  GradientHistogram::Part part_;
  double squares_ = 0.0;
};

class Gradients {
 public:
  explicit Gradients(const Field& phi)
      : phi_(phi), spacing_(phi.geometry.spacing_mm / glm::compMin(phi.geometry.spacing_mm)), values_(phi) {}

  void gather(std::int64_t page) {
    first_ = phi_.layout.first_voxel(page);
    values_.gather(page);
  }
  [[nodiscard]] double phi(Index3 local) const { return values_.at(local); }
  // None where a value that it is made of is clamped.
  [[nodiscard]] std::optional<double> at(Index3 local) const {
    if (is_clamped(values_.at(local))) return std::nullopt;
    glm::dvec3 gradient(0.0);
    for (int axis = 0; axis < 3; ++axis) {
      Index3 unit(0);
      unit[axis] = 1;
      const double above = values_.at(local + unit);
      const double below = values_.at(local - unit);
      if (is_clamped(above) || is_clamped(below)) return std::nullopt;
      const std::int64_t voxel = first_[axis] + local[axis];
      const bool at_border = voxel == 0 || voxel + 1 == phi_.geometry.size[axis];
      gradient[axis] = (above - below) * (at_border ? 1.0 : 0.5) / spacing_[axis];
    }
    return glm::length(gradient);
  }

 private:
  [[nodiscard]] bool is_clamped(double value) const {
    return std::abs(value) >= static_cast<double>(static_cast<float>(phi_.band));
  }

  const Field& phi_;
  glm::dvec3 spacing_;  // in units of the smallest
  PageWithApron values_;
  Index3 first_{0};
};

}  // namespace

Result<GradientHistogram> gradient_histogram(const Field& phi, double highest, const Progress& progress) {
  Counting near(highest);
  Counting band(highest);
  Gradients gradients(phi);
  for (std::int64_t page = 0; page < phi.layout.page_count(); ++page) {
    if (!phi.pages.is_stored(page)) continue;
    if (progress.cancelled()) return cancelled_error();
    gradients.gather(page);
    const Index3 valid = phi.layout.valid_shape(page);
    for (Index3 local(0); local.z < valid.z; ++local.z) {
      for (local.y = 0; local.y < valid.y; ++local.y) {
        for (local.x = 0; local.x < valid.x; ++local.x) {
          const auto gradient = gradients.at(local);
          if (!gradient) continue;
          band.add(*gradient);
          if (std::abs(gradients.phi(local)) <= GradientHistogram::kNear) near.add(*gradient);
        }
      }
    }
  }
  return GradientHistogram{highest, near.part(), band.part()};
}

}  // namespace tidemark::solver
