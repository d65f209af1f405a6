// The numerical kernel of the host executor: one step of one page, vectorised.
#pragma once

#include <string>
#include <string_view>

#include "core/result.h"
#include "solver/host/page_prefetch.h"
#include "solver/host/row_masks.h"
#include "solver/host/tile.h"
#include "solver/model.h"

namespace tidemark::solver {

struct PageJob {
  const HostFields* fields = nullptr;
  int buffer = 0;  // of the fields: the one that holds phi
  const PageInfo* info = nullptr;
  Tile* tile = nullptr;                // scratch
  const float* data_motion = nullptr;  // of the page
  const float* advection = nullptr;    // of the page, axis by axis; for kernels with advection
  float* next = nullptr;  // out: the new phi, in the rows of `rows`; in, for motion: phi a step ago
  Rows rows = 0;          // a multiple of PageKernels::rows_per_vector neighbouring rows
  const PagePrefetch* ahead = nullptr;  // what to ask for on the way
  const StepConstants<float>* constants = nullptr;
};

struct PageResult {
  RowMasks masks;  // of the computed rows
  // If motion is measured, of the computed voxels: the largest change over two steps beside the surface
  // (StepConstants::near), and a sample of PageContent.
  float largest_change = 0.0F;
  float content = 0.0F;
  std::int32_t near_voxels = 0;
};

// The kernel for one instruction set.
struct PageKernels {
  using Kernel = void (*)(const PageJob&, PageResult&);
  // [Scheme::paper][anisotropic spacing][motion is measured][advection]
  Kernel kernels[2][2][2][2] = {};
  int rows_per_vector = 1;
  std::string name;  // "sse4", "avx2", "avx512"
};

// The kernels for the named instruction set ("sse4", "avx2" or "avx512"), or the widest that this processor
// has when the name is empty. Fails (ErrorKind::capability) when the processor lacks it, and
// (ErrorKind::usage) on another name.
Result<PageKernels> select_page_kernels(std::string_view name);

}  // namespace tidemark::solver
