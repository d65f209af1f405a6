// Sums of a volume's values inside and outside of a surface.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "core/volume.h"
#include "solver/field.h"

namespace tidemark::solver {

// The mean brightness on either side of a surface.
struct RegionMeans {
  double inside = 0.0;
  double outside = 0.0;

  [[nodiscard]] double distance() const;
  bool operator==(const RegionMeans&) const = default;
};

// The sum of the volume's values in each page: pages that are inside as a whole need not be read again.
class RegionSums {
 public:
  RegionSums(std::shared_ptr<const Volume> source, const PageLayout& layout);

  [[nodiscard]] const PageLayout& layout() const { return layout_; }
  // For phi on the same layout, whose inside is where it is above 0. Unset: one side has no voxel. The same
  // bits for the same phi.
  [[nodiscard]] std::optional<RegionMeans> means(const Field& phi) const;

 private:
  std::shared_ptr<const Volume> source_;
  PageLayout layout_;
  std::vector<double> sums_;  // a page
  double total_ = 0.0;
};

}  // namespace tidemark::solver
