// The network that a random walker walks on: cells of the images, linked where they are alike.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/progress.h"
#include "core/result.h"
#include "core/thread_pool.h"
#include "core/volume.h"
#include "solver/speed/speed_function.h"
#include "solver/speed/strokes.h"

namespace tidemark::solver {

// Cell c holds the voxels from box.first + c * step, `step` along each axis or what is left of the box.
struct WalkerGrid {
  VoxelBox box;
  Index3 step{1};
  Index3 size{1};  // cells
};

// The walk's probabilities u have the least sum of link (u_i - u_j)^2 and end (u_i - prior_i)^2 that leaves
// the fixed ones as they are.
struct WalkerNetwork {
  Index3 size{1};
  glm::dvec3 step_mm{1.0};
  std::array<std::vector<float>, 3> link;  // from a cell to the next along an axis; 0: there is none
  std::vector<float> end;                  // how often a walk ends in the cell
  std::vector<float> prior;                // the probability that it is then given
  std::vector<std::int8_t> fixed;          // by strokes: 1 inside, 0 outside, -1 neither

  [[nodiscard]] std::int64_t cells() const { return size.x * size.y * size.z; }
  [[nodiscard]] std::int64_t stride(int axis) const {
    return axis == 0 ? 1 : axis == 1 ? size.x : size.x * size.y;
  }
};

// Around the strokes, with a margin in which the object may go on, of at most `most_cells`.
[[nodiscard]] WalkerGrid grid_around(const Strokes& strokes, const Geometry& geometry,
                                     std::int64_t most_cells);
// Links of exp(-contrast d^2) / h^2: h is the cells' distance in smallest spacings, d the root mean square
// over all images of their difference an h, in standard deviations of what the strokes hold. Ends and prior
// are left to the caller. Fails (ErrorKind::cancelled).
[[nodiscard]] Result<WalkerNetwork> network_of(const std::vector<std::shared_ptr<const Volume>>& images,
                                               const Strokes& strokes, const WalkerGrid& grid,
                                               double contrast, ThreadPool& threads,
                                               const Progress& progress);
// Joins cells by two along the axes that are not much longer than the shortest.
[[nodiscard]] WalkerNetwork coarser(const WalkerNetwork& fine);

}  // namespace tidemark::solver
