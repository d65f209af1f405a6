// The distribution of a volume's values: histograms and common range.
#pragma once

#include <cstdint>
#include <vector>

#include "core/progress.h"
#include "core/volume.h"

namespace tidemark::engine {

// For panels and the transfer function editor; measured once when a study is opened.
struct SourceSummary {
  float low = 0.0F;  // Volume::common_range()
  float high = 1.0F;
  float lowest = 0.0F;  // Volume::range()
  float highest = 1.0F;
  WindowLevel window;                // with which it is shown at first: window_of()
  static constexpr int kBins = 256;  // of [lowest, highest]
  std::vector<std::int64_t> values;  // kBins counts
  float steepest = 1.0F;             // the gradient magnitude (units a mm) that 1 in 200 exceeds
  // kBins x kBins counts over [low, high] x [0, steepest], value fastest; of a large study's voxels a sample.
  std::vector<std::int64_t> value_gradient;
};
// At a voxel, by central differences (to one side at the border), in units a mm.
float gradient_magnitude(const Volume& volume, Index3 voxel);
// The volume must not be empty. A summary that was stopped has counted only a part.
SourceSummary summarise(const Volume& volume, const Progress& progress = {});

}  // namespace tidemark::engine
