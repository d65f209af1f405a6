// A volume on a planned grid, out of slices that are decoded on the way.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "core/geometry.h"
#include "imaging/dicom/regular_grid.h"

namespace tidemark::imaging {

template <class Voxel>
struct SliceResampling {
  const GridPlan& plan;  // with slices
  Index3 size;           // of the slices: columns, rows, count
  // Decodes one slice into columns x rows voxels; false when it failed or was stopped. Called by several
  // threads, and again for a slice that several threads need.
  std::function<bool(std::int64_t slice, Voxel* target)> decode;
  std::function<void()> advance;    // one slice of the grid is done
  std::optional<Voxel> background;  // beside the slices; unset: their smallest value
};

// Linear within and between slices; integers are rounded. Fills `voxels`, which has the size of the grid, in
// parallel; each thread keeps two slices. False where decoding a slice was.
template <class Voxel>
bool resample_slices(const SliceResampling<Voxel>& work, std::vector<Voxel>& voxels);

}  // namespace tidemark::imaging
