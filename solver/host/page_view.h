// phi where an executor on the processor keeps it, for drawing without a copy.
#pragma once

#include "solver/paging/paged_memory.h"

namespace tidemark::solver {

// Valid until the next call to the executor.
struct PageView {
  const PagedMemory<3>* memory = nullptr;
  float band = 0.0F;
  // The voxels of a physical page from kFirstPage on, x fastest: `stride` floats from one page to the next.
  const float* pages = nullptr;  // of physical page 0
  std::int64_t stride = 0;

  [[nodiscard]] const float* phi(PhysicalPage page) const { return pages + page * stride; }
};

}  // namespace tidemark::solver
