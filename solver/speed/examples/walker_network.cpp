#include "solver/speed/examples/walker_network.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>

#include "core/typed_volume.h"
#include "solver/speed/examples/index.h"

namespace tidemark::solver {
namespace {

// The box reaches beyond the strokes by this share of their extent, and by as many smallest spacings.
constexpr double kMarginShare = 0.5;
constexpr double kLeastMargin = 16.0;
// Keeps every cell linked, however much it differs.
constexpr float kLeastLink = 1e-6F;

// The mean of each cell's voxels; not of all when it is cancelled.
std::vector<float> cell_values(const Volume& image, const WalkerGrid& grid, ThreadPool& threads,
                               const Progress& progress) {
  const Index3 size = grid.size;
  std::vector<float> values(at(size.x * size.y * size.z), 0.0F);
  threads.for_each(size.z, 1, [&](std::int64_t first, std::int64_t last, int) {
    with_type(image, [&](const auto& typed) {
      std::vector<float> counts(at(size.x));
      for (std::int64_t z = first; z < last && !progress.cancelled(); ++z) {
        for (std::int64_t y = 0; y < size.y; ++y) {
          float* row = &values[at(number_in(size, Index3(0, y, z)))];
          std::fill(counts.begin(), counts.end(), 0.0F);
          const Index3 begin = Index3(0, y, z) * grid.step;
          const Index3 end =
              glm::min(begin + Index3(grid.box.size.x, grid.step.y, grid.step.z), grid.box.size);
          for (std::int64_t k = begin.z; k < end.z; ++k) {
            for (std::int64_t j = begin.y; j < end.y; ++j) {
              const std::int64_t line = image.geometry.offset(grid.box.first + Index3(0, j, k));
              for (std::int64_t x = 0; x < size.x; ++x) {
                for (std::int64_t i = x * grid.step.x; i < std::min((x + 1) * grid.step.x, end.x); ++i) {
                  row[x] += typed.value(line + i);
                  counts[at(x)] += 1.0F;
                }
              }
            }
          }
          for (std::int64_t x = 0; x < size.x; ++x) row[x] /= counts[at(x)];
        }
      }
    });
  });
  return values;
}

// Of the values in all strokes: what tells inside from outside varies by so much.
double variance_of(const Volume& image, const Strokes& strokes) {
  double count = 0.0;
  double sum = 0.0;
  double squares = 0.0;
  for (const auto* stroke : {&strokes.inside, &strokes.outside}) {
    for (const std::int64_t offset : *stroke) {
      const double value = image.value(offset);
      const double before = count > 0.0 ? sum / count : value;
      count += 1.0;
      sum += value;
      squares += (value - before) * (value - sum / count);
    }
  }
  return std::max(squares / count, 1e-30);
}

// Adds scale d^2 to the links, d the difference of both cells an h.
void add_differences(const std::vector<float>& values, float scale, glm::vec3 steps, WalkerNetwork& network,
                     ThreadPool& threads) {
  for (int axis = 0; axis < 3; ++axis) {
    const std::int64_t stride = network.stride(axis);
    const float by = scale / (steps[axis] * steps[axis]);
    threads.for_each(network.cells() - stride, 1 << 14, [&](std::int64_t first, std::int64_t last, int) {
      for (std::int64_t i = first; i < last; ++i) {
        const float d = values[at(i + stride)] - values[at(i)];
        network.link[at(axis)][at(i)] += by * d * d;
      }
    });
  }
}

// A network's last cells along an axis have no next one.
void remove_last_links(int axis, WalkerNetwork& network) {
  Index3 last(0);
  last[axis] = network.size[axis] - 1;
  Index3 v;
  for (v.z = last.z; v.z < network.size.z; ++v.z) {
    for (v.y = last.y; v.y < network.size.y; ++v.y) {
      for (v.x = last.x; v.x < network.size.x; ++v.x) {
        network.link[at(axis)][at(number_in(network.size, v))] = 0.0F;
      }
    }
  }
}

// exp(-x), as (1 - x/32)^32: the same bits with every library of mathematics.
float decay(float x) {
  float power = std::max(1.0F - x * 0.03125F, 0.0F);
  for (int n = 0; n < 5; ++n) power *= power;
  return power;
}

void fix_strokes(const Strokes& strokes, const WalkerGrid& grid, const Geometry& geometry,
                 WalkerNetwork& network) {
  std::vector<std::int32_t> balance(at(network.cells()), 0);
  const auto count = [&](const std::vector<std::int64_t>& stroke, std::int32_t by) {
    for (const std::int64_t offset : stroke) {
      const Index3 cell = (geometry.voxel_at(offset) - grid.box.first) / grid.step;
      balance[at(number_in(network.size, cell))] += by;
    }
  };
  count(strokes.inside, 1);
  count(strokes.outside, -1);
  network.fixed.resize(balance.size());
  std::transform(balance.begin(), balance.end(), network.fixed.begin(), [](std::int32_t n) {
    return static_cast<std::int8_t>(n > 0 ? 1 : n < 0 ? 0 : -1);
  });
}

}  // namespace

WalkerGrid grid_around(const Strokes& strokes, const Geometry& geometry, std::int64_t most_cells) {
  Index3 low = geometry.size;
  Index3 high(-1);
  for (const auto* stroke : {&strokes.inside, &strokes.outside}) {
    for (const std::int64_t offset : *stroke) {
      const Index3 voxel = geometry.voxel_at(offset);
      low = glm::min(low, voxel);
      high = glm::max(high, voxel);
    }
  }
  const glm::dvec3& spacing = geometry.spacing_mm;
  const double unit = std::min({spacing.x, spacing.y, spacing.z});
  const glm::dvec3 extent = glm::dvec3(high - low) * spacing;
  const double margin =
      std::max(kLeastMargin * unit, kMarginShare * std::max({extent.x, extent.y, extent.z}));
  const Index3 reach(glm::ceil(glm::dvec3(margin) / spacing));
  low = glm::max(low - reach, Index3(0));
  high = glm::min(high + reach, geometry.size - Index3(1));
  WalkerGrid grid{{low, high - low + Index3(1)}, Index3(1), high - low + Index3(1)};
  while (grid.size.x * grid.size.y * grid.size.z > most_cells) {
    int finest = 0;
    for (int axis = 1; axis < 3; ++axis) {
      if (spacing[axis] * static_cast<double>(grid.step[axis]) <
          spacing[finest] * static_cast<double>(grid.step[finest]) * 0.999) {
        finest = axis;
      }
    }
    ++grid.step[finest];
    grid.size = (grid.box.size + grid.step - Index3(1)) / grid.step;
  }
  return grid;
}

Result<WalkerNetwork> network_of(const std::vector<std::shared_ptr<const Volume>>& images,
                                 const Strokes& strokes, const WalkerGrid& grid, double contrast,
                                 ThreadPool& threads, const Progress& progress) {
  const Geometry& geometry = images.front()->geometry;
  WalkerNetwork network;
  network.size = grid.size;
  network.step_mm = geometry.spacing_mm * glm::dvec3(grid.step);
  const double unit = std::min({geometry.spacing_mm.x, geometry.spacing_mm.y, geometry.spacing_mm.z});
  const glm::vec3 steps(network.step_mm / unit);
  for (auto& link : network.link) link.assign(at(network.cells()), 0.0F);
  for (const auto& image : images) {
    const double share = contrast / (variance_of(*image, strokes) * static_cast<double>(images.size()));
    const std::vector<float> values = cell_values(*image, grid, threads, progress);
    if (progress.cancelled()) return cancelled_error();
    add_differences(values, static_cast<float>(share), steps, network, threads);
  }
  for (int axis = 0; axis < 3; ++axis) {
    const float most = 1.0F / (steps[axis] * steps[axis]);
    threads.for_each(network.cells(), 1 << 14, [&](std::int64_t first, std::int64_t last, int) {
      for (std::int64_t i = first; i < last; ++i) {
        float& link = network.link[at(axis)][at(i)];
        link = most * decay(link) + kLeastLink;
      }
    });
    remove_last_links(axis, network);
  }
  fix_strokes(strokes, grid, geometry, network);
  return network;
}

WalkerNetwork coarser(const WalkerNetwork& fine) {
  const double shortest = std::min({fine.step_mm.x, fine.step_mm.y, fine.step_mm.z});
  Index3 factor(1);
  WalkerNetwork coarse;
  for (int axis = 0; axis < 3; ++axis) {
    if (fine.size[axis] > 1 && fine.step_mm[axis] < 1.5 * shortest) factor[axis] = 2;
  }
  if (factor == Index3(1)) {
    for (int axis = 0; axis < 3; ++axis) factor[axis] = fine.size[axis] > 1 ? 2 : 1;
  }
  coarse.size = (fine.size + factor - Index3(1)) / factor;
  coarse.step_mm = fine.step_mm * glm::dvec3(factor);
  for (auto& link : coarse.link) link.assign(at(coarse.cells()), 0.0F);
  coarse.end.assign(at(coarse.cells()), 0.0F);
  coarse.prior.assign(at(coarse.cells()), 0.0F);
  coarse.fixed.assign(at(coarse.cells()), -1);
  std::vector<std::uint8_t> kinds(at(coarse.cells()), 0);
  Index3 v;
  std::int64_t i = 0;
  for (v.z = 0; v.z < fine.size.z; ++v.z) {
    for (v.y = 0; v.y < fine.size.y; ++v.y) {
      for (v.x = 0; v.x < fine.size.x; ++v.x, ++i) {
        const Index3 cell = v / factor;
        const std::size_t c = at(number_in(coarse.size, cell));
        coarse.end[c] += fine.end[at(i)];
        coarse.prior[c] += fine.end[at(i)] * fine.prior[at(i)];
        if (fine.fixed[at(i)] >= 0) kinds[c] |= fine.fixed[at(i)] > 0 ? 2 : 1;
        for (int axis = 0; axis < 3; ++axis) {
          const std::int64_t stride = fine.stride(axis);
          const float link = fine.link[at(axis)][at(i)];
          if (link <= 0.0F) continue;
          if (factor[axis] == 1) {
            coarse.link[at(axis)][c] += link;
          } else if (v[axis] % 2 == 1) {
            // In a row: half of the links within both cells, and the one between them.
            float resistance = 1.0F / link + 0.5F / std::max(fine.link[at(axis)][at(i - stride)], kLeastLink);
            const bool within = v[axis] + 2 < fine.size[axis];
            if (within) resistance += 0.5F / std::max(fine.link[at(axis)][at(i + stride)], kLeastLink);
            coarse.link[at(axis)][c] += 1.0F / resistance;
          }
        }
      }
    }
  }
  for (std::size_t c = 0; c < kinds.size(); ++c) {
    coarse.prior[c] /= coarse.end[c];
    if (kinds[c] == 1 || kinds[c] == 2) coarse.fixed[c] = static_cast<std::int8_t>(kinds[c] - 1);
  }
  return coarse;
}

}  // namespace tidemark::solver
