// The histogram of |grad phi|, which the rescaling term holds at its target.
#pragma once

#include <array>
#include <cstdint>

#include "core/progress.h"
#include "solver/field.h"

namespace tidemark::solver {

// |grad phi| by central differences, one-sided at the volume's border, without unit: phi and lengths are in
// smallest spacings.
struct GradientHistogram {
  static constexpr int kBins = 48;
  // How far from the surface voxels count as near: |phi|, smallest spacings.
  static constexpr double kNear = 1.5;

  struct Part {
    std::array<std::int64_t, kBins> counts{};  // what is larger is in the last one
    std::int64_t voxels = 0;
    double mean = 0.0;
    double deviation = 0.0;  // standard deviation of the population

    bool operator==(const Part&) const = default;
  };
  double highest = 2.0;  // the end of the last bin; the first begins at 0
  Part near;             // the voxels near the surface
  Part band;             // all whose neighbours across faces are not clamped, nor they themselves

  bool operator==(const GradientHistogram&) const = default;
};

// `highest` > 0. Looks at resident pages alone. Fails (ErrorKind::cancelled).
Result<GradientHistogram> gradient_histogram(const Field& phi, double highest, const Progress& progress = {});

}  // namespace tidemark::solver
