// The probability that a random walk from a voxel meets a stroke inside before one outside. Walks seldom
// cross edges of the images. On its way a walk ends now and then, and is counted by what the forest says of
// the place.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "core/progress.h"
#include "core/result.h"
#include "solver/speed/examples/walker_network.h"

namespace tidemark::solver {

struct WalkerOptions {
  // How much a difference of the images holds walks back (network_of).
  double contrast = 20.0;
  // How often a walk ends in a cell, against a step of 1 to a cell that is alike.
  double prior = 0.003;
  // How much the forest is moved towards "outside" where it is in doubt: p - caution (1 - |2p - 1|). A miss
  // is small and seen at once; a leak takes the surface far away.
  double caution = 0.1;
  // Over each of the grids, the coarsest first: so many leave the probabilities right to 0.02.
  int sweeps = 24;
  std::int64_t most_cells = 1'000'000;
};

// L. Grady, "Random Walks for Image Segmentation", IEEE PAMI 28(11), 2006, with the priors of his
// "Multilabel Random Walker Image Segmentation Using Prior Models", CVPR 2005. It is solved in a box around
// the strokes, on cells of several voxels where the box is large.
//
// Thread-safe when made. The same input gives the same bits, for any number of threads.
class RandomWalker {
 public:
  // Writes the forest's probabilities of the cells [first, last) in z, x fastest.
  using Prior =
      std::function<void(const WalkerGrid& grid, std::int64_t first, std::int64_t last, float* inside)>;

  // Of images on one grid, and strokes of both kinds. Fails (ErrorKind::cancelled).
  static Result<RandomWalker> solve(const std::vector<std::shared_ptr<const Volume>>& images,
                                    const Strokes& strokes, const WalkerOptions& options, const Prior& prior,
                                    const Progress& progress);

  [[nodiscard]] const WalkerGrid& grid() const { return grid_; }
  // Of each voxel of a box that lies within that of the grid, x fastest.
  void evaluate(const VoxelBox& box, double* inside) const;

 private:
  RandomWalker(const WalkerGrid& grid, std::vector<float> inside) : grid_(grid), inside_(std::move(inside)) {}

  WalkerGrid grid_;
  std::vector<float> inside_;
};

}  // namespace tidemark::solver
