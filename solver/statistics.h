// The measurements on a level set.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "solver/field.h"

namespace tidemark::solver {

struct SurfaceStatistics {
  std::int64_t voxels_inside = 0;  // phi > 0
  double volume_ml = 0.0;          // inside phi = 0, at sub-voxel precision
  double surface_mm2 = 0.0;        // area of phi = 0 at sub-voxel precision, without the volume's own border
};

SurfaceStatistics measure(const Field& phi);

// Measures one copy of a level set after the other: what a copy shares with the one before is not measured
// again. The figures are those of measure(), to the last bit.
class SurfaceMeter {
 public:
  // `threads` as of ThreadPool.
  explicit SurfaceMeter(int threads = 1) : threads_(threads) {}

  SurfaceStatistics measure(const Field& phi);

 private:
  // Of a stored page.
  struct PageSums {
    std::int64_t voxels_inside = 0;
    double voxels = 0.0;  // inside phi = 0
    double surface_mm2 = 0.0;
  };
  void follow(const Field& phi);
  void begin(const Field& phi);
  void add(const Field& phi, const std::vector<std::int64_t>& pages);
  [[nodiscard]] static PageSums sums_of(const Field& phi, std::int64_t page, class PageWithApron& values);

  int threads_;
  std::optional<Field> measured_;
  std::map<std::int64_t, PageSums> sums_;
  std::int64_t constant_inside_ = 0;  // voxels of pages that are inside throughout
};

}  // namespace tidemark::solver
