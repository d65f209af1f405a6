// The agreement of a level set with a known answer while it moves.
#pragma once

#include <memory>
#include <vector>

#include "core/bit_mask.h"
#include "solver/field.h"

namespace tidemark::engine {

class TruthOverlap {
 public:
  explicit TruthOverlap(std::shared_ptr<const BitMask> truth) : truth_(std::move(truth)) {}

  // 2 |A and B| / (|A| + |B|) of what is inside phi and the truth; 1 when both are empty. phi must be on the
  // truth's grid. Voxels are looked at in those stored pages alone that it does not share with the phi
  // before; of pages that are inside throughout it is known how much of the truth they hold.
  double dice(const solver::Field& phi);

 private:
  struct Counts {
    std::int64_t inside = 0;  // voxels
    std::int64_t common = 0;  // of them in the truth
  };
  void begin(const solver::Field& phi);
  [[nodiscard]] Counts count(const SharedPages& pages, std::int64_t page) const;

  std::shared_ptr<const BitMask> truth_;
  PageLayout layout_;                  // as of the next two
  std::vector<std::int64_t> in_page_;  // voxels of the truth
  std::int64_t in_truth_ = 0;
  SharedPages counted_;  // the last phi, and what it has
  Counts counts_;
};

}  // namespace tidemark::engine
