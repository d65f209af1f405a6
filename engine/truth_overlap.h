// The agreement of a level set with a known answer while it moves.
#pragma once

#include <memory>
#include <vector>

#include "solver/field.h"

namespace tidemark::engine {

class TruthOverlap {
 public:
  explicit TruthOverlap(std::shared_ptr<const Mask> truth) : truth_(std::move(truth)) {}

  // 2 |A and B| / (|A| + |B|) of what is inside phi and the truth; 1 when both are empty. Voxels are looked
  // at in resident pages alone: of the other pages it is known how much of the truth they hold. phi must be
  // on the truth's grid.
  double dice(const solver::Field& phi);

 private:
  void count_pages(const solver::PageLayout& layout);

  std::shared_ptr<const Mask> truth_;
  solver::PageLayout layout_;          // as of the next two
  std::vector<std::int64_t> in_page_;  // voxels of the truth
  std::int64_t in_truth_ = 0;
};

}  // namespace tidemark::engine
