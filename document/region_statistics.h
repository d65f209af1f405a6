// Statistics of a volume's values by region.
#pragma once

#include <memory>
#include <vector>

#include "document/labels.h"
#include "solver/field.h"

namespace tidemark::document {

// Figures of the inside of a label or a surface.
struct RegionStatistics {
  std::int64_t voxels = 0;
  double volume_ml = 0.0;
  double mean = 0.0;                // of the volume's values, in its units
  double standard_deviation = 0.0;  // of the population
};

// Sums of stored values. The shift keeps the squares small where all values are far from 0 (Welford's update
// would divide at every voxel).
struct ValueSums {
  std::int64_t voxels = 0;
  double shift = 0.0;
  double sum = 0.0;
  double squares = 0.0;

  void add(double stored) {
    if (voxels == 0) shift = stored;
    add_to_shift(stored);
  }
  void add_to_shift(double stored) {
    ++voxels;
    const double d = stored - shift;
    sum += d;
    squares += d * d;
  }
  void take_away(double stored) {
    --voxels;
    const double d = stored - shift;
    sum -= d;
    squares -= d * d;
  }
  [[nodiscard]] RegionStatistics result(const Volume& volume) const;
};

// Of all labels at once, of one state of them after the other: slices that a state shares with the one before
// are not looked at again.
class LabelStatistics {
 public:
  // By id (256 entries). The labels must be on the volume's grid.
  std::vector<RegionStatistics> measure(const std::shared_ptr<const Volume>& volume,
                                        const PagedBytes& labels);

 private:
  std::shared_ptr<const Volume> volume_;  // null: nothing was measured
  PagedBytes measured_;
  std::vector<ValueSums> sums_;  // of 0, nothing
};

// Of what is inside one copy of a level set after the other: what a copy shares with the one before is not
// looked at again.
class InsideStatistics {
 public:
  // phi must be on the volume's grid.
  RegionStatistics measure(const std::shared_ptr<const Volume>& volume, const solver::Field& phi);

 private:
  void begin(const std::shared_ptr<const Volume>& volume, const solver::Field& phi);
  [[nodiscard]] ValueSums sums_of(const SharedPages& pages, std::int64_t page) const;

  std::shared_ptr<const Volume> volume_;  // null: nothing was measured
  PageLayout layout_;
  SharedPages measured_;
  ValueSums sums_;
};

}  // namespace tidemark::document
