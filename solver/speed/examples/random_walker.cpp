#include "solver/speed/examples/random_walker.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "solver/speed/examples/index.h"

namespace tidemark::solver {
namespace {

constexpr std::int64_t kCoarsestCells = 2000;
constexpr float kOverrelaxation = 1.6F;

// Trilinear, from the centres of coarse cells to those of fine ones along each axis.
struct BetweenCells {
  std::vector<std::int64_t> cell;  // the one before
  std::vector<float> weight;       // of the one after
};
// Of `count` points from `first`, `step` of which make a cell of `cells`.
BetweenCells between_cells(std::int64_t first, std::int64_t count, std::int64_t step, std::int64_t cells) {
  BetweenCells result;
  for (std::int64_t i = first; i < first + count; ++i) {
    const double place = std::clamp((static_cast<double>(i) + 0.5) / static_cast<double>(step) - 0.5, 0.0,
                                    static_cast<double>(cells - 1));
    const auto cell = std::min(static_cast<std::int64_t>(place), std::max<std::int64_t>(cells - 2, 0));
    result.cell.push_back(cell);
    result.weight.push_back(static_cast<float>(place - static_cast<double>(cell)));
  }
  return result;
}

template <class Value>
void interpolate(const std::vector<float>& cells, Index3 size, const std::array<BetweenCells, 3>& to,
                 Value* values) {
  const std::int64_t right = size.x > 1 ? 1 : 0;
  const std::int64_t down = size.y > 1 ? size.x : 0;
  const std::int64_t deep = size.z > 1 ? size.x * size.y : 0;
  for (std::size_t z = 0; z < to[2].cell.size(); ++z) {
    for (std::size_t y = 0; y < to[1].cell.size(); ++y) {
      const float* row = &cells[at(size.x * (to[1].cell[y] + size.y * to[2].cell[z]))];
      const float wy = to[1].weight[y];
      const float wz = to[2].weight[z];
      for (std::size_t x = 0; x < to[0].cell.size(); ++x) {
        const float* c = row + to[0].cell[x];
        const float wx = to[0].weight[x];
        const auto along = [&](const float* p) { return p[0] + wx * (p[right] - p[0]); };
        const float near = along(c) + wy * (along(c + down) - along(c));
        const float far = along(c + deep) + wy * (along(c + deep + down) - along(c + deep));
        *values++ = static_cast<Value>(near + wz * (far - near));
      }
    }
  }
}

// Red cells take the mean of black ones, then black ones that of red ones: any order gives the same bits.
void relax(const WalkerNetwork& network, int sweeps, std::vector<float>& u, ThreadPool& threads,
           const Progress& progress) {
  const Index3 size = network.size;
  const std::array<std::int64_t, 3> stride{network.stride(0), network.stride(1), network.stride(2)};
  for (int half = 0; half < 2 * sweeps && !progress.cancelled(); ++half) {
    threads.for_each(size.z, 2, [&](std::int64_t first, std::int64_t last, int) {
      for (std::int64_t z = first; z < last; ++z) {
        for (std::int64_t y = 0; y < size.y; ++y) {
          const std::int64_t row = number_in(size, Index3(0, y, z));
          for (std::int64_t x = (y + z + half) % 2; x < size.x; x += 2) {
            const std::size_t i = at(row + x);
            if (network.fixed[i] >= 0) continue;
            const float link[6] = {x > 0 ? network.link[0][i - 1] : 0.0F,
                                   network.link[0][i],
                                   y > 0 ? network.link[1][i - at(stride[1])] : 0.0F,
                                   network.link[1][i],
                                   z > 0 ? network.link[2][i - at(stride[2])] : 0.0F,
                                   network.link[2][i]};
            float weight = network.end[i];
            float sum = weight * network.prior[i];
            for (int axis = 0; axis < 3; ++axis) {
              const float before = link[2 * axis];
              const float after = link[2 * axis + 1];
              if (before > 0.0F) sum += before * u[i - at(stride[at(axis)])];
              if (after > 0.0F) sum += after * u[i + at(stride[at(axis)])];
              weight += before + after;
            }
            u[i] += kOverrelaxation * (sum / weight - u[i]);
          }
        }
      }
    });
  }
}

std::vector<float> solved(const WalkerNetwork& network, int sweeps, ThreadPool& threads,
                          const Progress& progress) {
  std::vector<float> u = network.prior;
  const bool coarsest = network.cells() <= kCoarsestCells;
  if (!coarsest) {
    const WalkerNetwork coarse = coarser(network);
    const std::vector<float> start = solved(coarse, sweeps, threads, progress);
    std::array<BetweenCells, 3> to;
    for (int axis = 0; axis < 3; ++axis) {
      const std::int64_t factor = coarse.size[axis] < network.size[axis] ? 2 : 1;
      to[at(axis)] = between_cells(0, network.size[axis], factor, coarse.size[axis]);
    }
    interpolate(start, coarse.size, to, u.data());
  }
  for (std::size_t i = 0; i < u.size(); ++i) {
    if (network.fixed[i] >= 0) u[i] = network.fixed[i];
  }
  relax(network, coarsest ? 10 * sweeps : sweeps, u, threads, progress);
  return u;
}

}  // namespace

Result<RandomWalker> RandomWalker::solve(const std::vector<std::shared_ptr<const Volume>>& images,
                                         const Strokes& strokes, const WalkerOptions& options,
                                         const Prior& prior, const Progress& progress) {
  ThreadPool threads;
  const WalkerGrid grid = grid_around(strokes, images.front()->geometry, options.most_cells);
  auto network = network_of(images, strokes, grid, options.contrast, threads, progress);
  if (!network) return pass_on(network);
  network->end.assign(at(network->cells()), static_cast<float>(options.prior));
  network->prior.resize(at(network->cells()));
  threads.for_each(grid.size.z, 1, [&](std::int64_t first, std::int64_t last, int) {
    if (progress.cancelled()) return;
    float* inside = &network->prior[at(first * network->stride(2))];
    prior(grid, first, last, inside);
    const auto caution = static_cast<float>(options.caution);
    std::transform(inside, inside + (last - first) * network->stride(2), inside,
                   [&](float p) { return p - caution * (1.0F - std::abs(2.0F * p - 1.0F)); });
  });
  std::vector<float> inside = solved(*network, options.sweeps, threads, progress);
  if (progress.cancelled()) return cancelled_error();
  return RandomWalker(grid, std::move(inside));
}

void RandomWalker::evaluate(const VoxelBox& box, double* inside) const {
  std::array<BetweenCells, 3> to;
  for (int axis = 0; axis < 3; ++axis) {
    to[at(axis)] = between_cells(box.first[axis] - grid_.box.first[axis], box.size[axis], grid_.step[axis],
                                 grid_.size[axis]);
  }
  interpolate(inside_, grid_.size, to, inside);
}

}  // namespace tidemark::solver
