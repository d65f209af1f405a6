// The numerical kernel of the host executor: one step of one page, vectorised.
#pragma once

#include <string>
#include <string_view>

#include "core/result.h"
#include "solver/host/row_masks.h"
#include "solver/host/tile.h"
#include "solver/model.h"

namespace tidemark {

struct PageJob {
  const Tile* tile = nullptr;
  const float* source = nullptr;  // of the page
  float* next = nullptr;          // in: phi of one step earlier; out: the new phi, in the rows of `rows`
  Rows rows = 0;                  // a multiple of PageKernels::rows_per_vector neighbouring rows
  int valid_x = kPageSide;        // voxels of a row that are inside the volume
  const StepConstants<float>* constants = nullptr;
};

struct PageResult {
  RowMasks masks;  // of the computed rows
  // Over the computed voxels beside the surface (StepConstants::near), the change over two steps:
  float largest_change = 0.0F;
  float squared_change = 0.0F;
  std::int32_t near_voxels = 0;
};

// The kernel for one instruction set.
struct PageKernels {
  using Kernel = void (*)(const PageJob&, PageResult&);
  Kernel split[2] = {};  // Scheme::split; [1]: anisotropic spacing
  Kernel paper[2] = {};  // Scheme::paper
  int rows_per_vector = 1;
  std::string name;  // "sse4", "avx2", "avx512"
};

// The kernels for the named instruction set ("sse4", "avx2" or "avx512"), or the widest that this processor
// has when the name is empty. Fails (ErrorKind::capability) when the processor lacks it, and
// (ErrorKind::usage) on another name.
Result<PageKernels> select_page_kernels(std::string_view name);

}  // namespace tidemark
