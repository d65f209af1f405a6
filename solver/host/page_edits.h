// Replacing and painting phi in the host executor.
#pragma once

#include <vector>

#include "solver/executor.h"
#include "solver/host/quiet_pages.h"
#include "solver/host/resident_pages.h"

namespace tidemark::solver {

// An edit is done when there is room for the pages that it changes. Pages beside them that find none are
// asked for again by the next run (ResidentPages::needs_activation()).
class PageEdits {
 public:
  // What it is made from outlives it.
  PageEdits(const ResidentPages::Contents& contents, ResidentPages& pages, QuietPages& quiet)
      : contents_(contents), pages_(pages), quiet_(quiet) {}

  // As Executor's.
  Status restore(const Field& phi);
  Status paint(const Sphere& sphere, Brush brush);
  // Makes resident what the constraints need, and takes phi to their limits.
  Status constrain();

 private:
  Status constrain(const std::vector<std::int64_t>& virtual_pages);
  // Whether a page may be all inside, or all outside.
  [[nodiscard]] bool may_be_constant(std::int64_t virtual_page, bool inside) const;

  ResidentPages::Contents contents_;
  ResidentPages& pages_;
  QuietPages& quiet_;
};

}  // namespace tidemark::solver
