// Replacing and painting phi in the host executor.
#pragma once

#include "solver/executor.h"
#include "solver/host/quiet_pages.h"
#include "solver/host/resident_pages.h"

namespace tidemark::solver {

class PageEdits {
 public:
  // What it is made from outlives it.
  PageEdits(const Volume& source, const Model& model, ResidentPages& pages, QuietPages& quiet)
      : source_(source), model_(model), pages_(pages), quiet_(quiet) {}

  // As Executor's.
  Status restore(const Field& phi);
  Status paint(const Sphere& sphere, Brush brush);

 private:
  const Volume& source_;
  const Model& model_;
  ResidentPages& pages_;
  QuietPages& quiet_;
};

}  // namespace tidemark::solver
