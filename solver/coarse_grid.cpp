#include "solver/coarse_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/gtx/component_wise.hpp>
#include <span>
#include <vector>

#include "core/index_walk.h"
#include "core/thread_pool.h"

namespace tidemark::solver {
namespace {

constexpr std::int64_t kSmallEnough = std::int64_t{1} << 21;  // voxels

// The voxels before and after a place along an axis, and how far it lies from the first to the second.
struct Between {
  std::int64_t low = 0;
  std::int64_t high = 0;
  float weight = 0.0F;
};

Between between(std::int64_t fine, std::int64_t factor, std::int64_t coarse_size) {
  const double place = (static_cast<double>(fine) + 0.5) / static_cast<double>(factor) - 0.5;
  const auto low = static_cast<std::int64_t>(std::floor(place));
  return {std::clamp<std::int64_t>(low, 0, coarse_size - 1),
          std::clamp<std::int64_t>(low + 1, 0, coarse_size - 1),
          static_cast<float>(place - static_cast<double>(low))};
}

// The coarse voxels around those of a page of the fine grid, along an axis.
struct Reach {
  std::vector<Between> voxels;  // of the page
  std::int64_t from = 0;        // the coarse ones that take part
  std::int64_t size = 1;
  std::int64_t first_page = 0;  // of the coarse phi, in which they lie
  std::int64_t last_page = 0;
};

using Along = std::array<const Reach*, 3>;  // of a page, by axis

// phi of a coarse grid at the voxels of the pages of the fine grid. Each thread has one.
class PageRefiner {
 public:
  // What the page is. The values of one that is stored are written, -limit beyond the grid.
  Field::Kind refine(const Field& coarse, const Along& along, float scale, float limit, Index3 page_shape,
                     std::span<float> values) {
    gather(coarse, along);
    // phi between voxels is not beyond theirs: where all of them are clamped the page is constant.
    if (std::ranges::all_of(block_, [&](float phi) { return scale * phi <= -limit; }))
      return Field::Kind::outside;
    if (std::ranges::all_of(block_, [&](float phi) { return scale * phi >= limit; }))
      return Field::Kind::inside;
    interpolate(along, scale, limit, page_shape, values);
    return Field::Kind::stored;
  }

 private:
  // Row by row, each as far as a page goes.
  void gather(const Field& coarse, const Along& along) {
    const auto [x, y, z] = along;
    const std::int64_t side = coarse.layout.page_shape().x;
    const std::int64_t end = x->from + x->size;
    block_.resize(static_cast<std::size_t>(x->size * y->size * z->size));
    float* to = block_.data();
    for_each_index({x->from, y->from, z->from}, {x->from + 1, y->from + y->size, z->from + z->size},
                   [&](Index3 voxel) {
                     while (voxel.x < end) {
                       const VirtualAddress address = coarse.layout.translate(voxel);
                       const std::int64_t count = std::min((voxel.x / side + 1) * side, end) - voxel.x;
                       const float* const values = coarse.pages.values(address.page);
                       to = values == nullptr ? std::fill_n(to, count, coarse.constant(address.page))
                                              : std::copy_n(values + address.offset, count, to);
                       voxel.x += count;
                     }
                   });
  }

  // Along one axis after the other: what lies side by side shares the interpolation along the axes before.
  void interpolate(const Along& along, float scale, float limit, Index3 page_shape, std::span<float> values) {
    const auto [x, y, z] = along;
    const auto width = std::ssize(x->voxels);
    const auto height = std::ssize(y->voxels);
    rows_.resize(static_cast<std::size_t>(width * y->size * z->size));
    float* to = rows_.data();
    for (const float* row = block_.data(); row != block_.data() + block_.size(); row += x->size) {
      for (const Between& i : x->voxels) *to++ = mixed(row[i.low], row[i.high], i.weight);
    }
    planes_.resize(static_cast<std::size_t>(width * height * z->size));
    to = planes_.data();
    for (std::int64_t k = 0; k < z->size; ++k) {
      const float* const rows = rows_.data() + width * y->size * k;
      for (const Between& j : y->voxels)
        to = mix(rows + width * j.low, rows + width * j.high, j.weight, width, to);
    }
    std::fill(values.begin(), values.end(), -limit);
    for (std::size_t k = 0; k < z->voxels.size(); ++k) {
      const Between& between = z->voxels[k];
      for (std::int64_t j = 0; j < height; ++j) {
        const float* const low = planes_.data() + width * (j + height * between.low);
        const float* const high = planes_.data() + width * (j + height * between.high);
        float* const row = values.data() + page_shape.x * (j + page_shape.y * static_cast<std::int64_t>(k));
        mix(low, high, between.weight, width, row);
        for (std::int64_t i = 0; i < width; ++i) row[i] = std::clamp(scale * row[i], -limit, limit);
      }
    }
  }

  static float mixed(float low, float high, float weight) { return low + weight * (high - low); }
  static float* mix(const float* low, const float* high, float weight, std::int64_t count, float* to) {
    for (std::int64_t i = 0; i < count; ++i) to[i] = mixed(low[i], high[i], weight);
    return to + count;
  }

  // phi of the coarse voxels that take part, x fastest; then of the page's voxels along x; along x and y.
  std::vector<float> block_;
  std::vector<float> rows_;
  std::vector<float> planes_;
};

// phi of a coarse grid on the fine one.
class Refiner {
 public:
  Refiner(const Field& coarse, const CoarseGrid& grid, Field& fine)
      : coarse_(coarse), grid_(grid), fine_(fine) {
    for (std::int64_t page = 0; page < coarse.layout.page_count(); ++page)
      kinds_.push_back(coarse.pages.kind(page));
    for (int axis = 0; axis < 3; ++axis) {
      for (std::int64_t page = 0; page < fine.layout.pages()[axis]; ++page) add_reach(axis, page);
    }
  }

  void run(int threads) {
    find_pages();
    // Threads compute, one stores, so that pages lie in memory in their order.
    constexpr std::int64_t kAtOnce = 256;
    ThreadPool pool(threads);
    std::vector<PageRefiner> refiners(static_cast<std::size_t>(pool.threads()));
    const std::int64_t length = fine_.layout.voxels_per_page();
    const std::int64_t most = std::min(kAtOnce, std::ssize(varying_));
    std::vector<float> values(static_cast<std::size_t>(most * length));
    std::vector<Field::Kind> kinds(static_cast<std::size_t>(most));
    const auto of = [&](std::int64_t place) {
      return std::span(values).subspan(static_cast<std::size_t>(place * length),
                                       static_cast<std::size_t>(length));
    };
    for (std::int64_t first = 0; first < std::ssize(varying_); first += kAtOnce) {
      const auto pages = std::span(varying_).subspan(
          static_cast<std::size_t>(first),
          static_cast<std::size_t>(std::min(kAtOnce, std::ssize(varying_) - first)));
      pool.for_each(std::ssize(pages), 8, [&](std::int64_t begin, std::int64_t end, int member) {
        for (std::int64_t i = begin; i < end; ++i) {
          const auto place = static_cast<std::size_t>(i);
          kinds[place] = refiners[static_cast<std::size_t>(member)].refine(
              coarse_, along(pages[place]), static_cast<float>(grid_.scale()), static_cast<float>(fine_.band),
              fine_.layout.page_shape(), of(i));
        }
      });
      for (std::int64_t i = 0; i < std::ssize(pages); ++i) {
        const auto place = static_cast<std::size_t>(i);
        const std::int64_t page = fine_.layout.page_number(pages[place]);
        if (kinds[place] == Field::Kind::stored) {
          fine_.store_page(page, of(i));
        } else {
          fine_.pages.set_constant(page, kinds[place]);
        }
      }
    }
  }

 private:
  void add_reach(int axis, std::int64_t page) {
    const std::int64_t side = fine_.layout.page_shape()[axis];
    const std::int64_t end = std::min((page + 1) * side, fine_.layout.domain_size()[axis]);
    Reach reach;
    for (std::int64_t voxel = page * side; voxel < end; ++voxel)
      reach.voxels.push_back(between(voxel, grid_.factor()[axis], grid_.coarse().size[axis]));
    reach.from = reach.voxels.front().low;
    reach.size = reach.voxels.back().high - reach.from + 1;
    reach.first_page = reach.from / coarse_.layout.page_shape()[axis];
    reach.last_page = reach.voxels.back().high / coarse_.layout.page_shape()[axis];
    for (Between& voxel : reach.voxels) {
      voxel.low -= reach.from;
      voxel.high -= reach.from;
    }
    reaches_[static_cast<std::size_t>(axis)].push_back(std::move(reach));
  }

  [[nodiscard]] Along along(Index3 page) const {
    Along reaches{};
    for (int axis = 0; axis < 3; ++axis) {
      const auto at = static_cast<std::size_t>(axis);
      reaches[at] = &reaches_[at][static_cast<std::size_t>(page[axis])];
    }
    return reaches;
  }

  // Sets the pages that are constant, and remembers the others. Most rows of pages are outside, as all of phi
  // is at first.
  void find_pages() {
    const Index3 pages = fine_.layout.pages();
    for_each_index(Index3(0), {1, pages.y, pages.z}, [&](Index3 row) {
      if (is_row_outside(along(row))) return;
      for_each_index(row, row + Index3(pages.x, 1, 1), [&](Index3 page) {
        const auto constant = constant_around(along(page));
        if (!constant) return varying_.push_back(page);
        if (*constant == Field::Kind::outside) return;
        fine_.pages.set_constant(fine_.layout.page_number(page), *constant);
      });
    });
  }

  // Of the coarse pages around a row of the fine ones.
  [[nodiscard]] bool is_row_outside(const Along& along) const {
    const auto [x, y, z] = along;
    return all_indices({0, y->first_page, z->first_page}, {1, y->last_page + 1, z->last_page + 1},
                       [&](Index3 row) {
                         const auto first = kinds_.begin() + coarse_.layout.page_number(row);
                         return std::all_of(first, first + coarse_.layout.pages().x,
                                            [](Field::Kind kind) { return kind == Field::Kind::outside; });
                       });
  }

  // What stands for a page where no stored page of the coarse phi reaches it.
  [[nodiscard]] std::optional<Field::Kind> constant_around(const Along& along) const {
    const auto [x, y, z] = along;
    const Field::Kind one = kind_at({x->first_page, y->first_page, z->first_page});
    const bool same = one != Field::Kind::stored &&
                      all_indices({x->first_page, y->first_page, z->first_page},
                                  Index3(x->last_page, y->last_page, z->last_page) + Index3(1),
                                  [&](Index3 page) { return kind_at(page) == one; });
    return same ? std::optional(one) : std::nullopt;
  }
  [[nodiscard]] Field::Kind kind_at(Index3 page) const {
    return kinds_[static_cast<std::size_t>(coarse_.layout.page_number(page))];
  }

  const Field& coarse_;
  const CoarseGrid& grid_;
  Field& fine_;
  std::vector<Field::Kind> kinds_;             // of the coarse pages, each of which is asked for many times
  std::array<std::vector<Reach>, 3> reaches_;  // by axis and page
  std::vector<Index3> varying_;                // pages
};

}  // namespace

CoarseGrid::CoarseGrid(const Geometry& fine, int halvings) : fine_(fine), coarse_(fine) {
  for (int halving = 0; halving < halvings; ++halving) {
    const double smallest = glm::compMin(coarse_.spacing_mm);
    for (int axis = 0; axis < 3; ++axis) {
      const bool halved = coarse_.size[axis] > 1 && coarse_.spacing_mm[axis] <= kLikeSpacing * smallest;
      if (halved) factor_[axis] *= 2;
    }
    coarse_.size = (fine.size + factor_ - Index3(1)) / factor_;
    coarse_.spacing_mm = fine.spacing_mm * glm::dvec3(factor_);
  }
  coarse_.origin_mm = fine.to_patient((glm::dvec3(factor_) - 1.0) / 2.0);
  scale_ = glm::compMin(coarse_.spacing_mm) / glm::compMin(fine.spacing_mm);
}

Index3 CoarseGrid::size_of(Index3 block) const {
  return glm::min(factor_, fine_.size - first_of(block));
}

int levels_for(const Geometry& geometry) {
  int levels = 1;
  while (levels < CoarseGrid::kMostLevels &&
         CoarseGrid(geometry, levels - 1).coarse().voxel_count() > kSmallEnough) {
    ++levels;
  }
  return levels;
}

Mask coarsened(const Inside& inside, const CoarseGrid& grid) {
  const Index3 blocks = grid.coarse().size;
  Mask result{grid.coarse(), {}};
  result.voxels.reserve(static_cast<std::size_t>(grid.coarse().voxel_count()));
  std::vector<std::uint8_t> row(static_cast<std::size_t>(grid.fine().size.x));
  std::vector<std::int64_t> counts(static_cast<std::size_t>(blocks.x));  // voxels inside in a row of blocks
  for_each_index(Index3(0), {1, blocks.y, blocks.z}, [&](Index3 first) {
    std::fill(counts.begin(), counts.end(), 0);
    const Index3 size = grid.size_of(first);
    const Index3 row_of_blocks = grid.first_of(first);
    for_each_index(row_of_blocks, row_of_blocks + Index3(1, size.y, size.z), [&](Index3 voxel) {
      inside.read(inside.geometry.offset(voxel), row);
      for (std::size_t x = 0; x < row.size(); ++x) {
        counts[x / static_cast<std::size_t>(grid.factor().x)] += row[x];
      }
    });
    for (std::int64_t x = 0; x < blocks.x; ++x) {
      const std::int64_t voxels = grid.size_of({x, first.y, first.z}).x * size.y * size.z;
      result.voxels.push_back(2 * counts[static_cast<std::size_t>(x)] >= voxels ? 1 : 0);
    }
  });
  return result;
}

Constraints coarsened(const Constraints& constraints, const CoarseGrid& grid) {
  std::vector<Index3> walls;
  std::vector<Index3> anchors;
  const PageLayout& layout = constraints.layout();
  for (const std::int64_t page : constraints.pages().stored_pages()) {
    // Sides of pages are multiples of every factor: no block lies in two of them.
    const Index3 first = layout.first_voxel(page) / grid.factor();
    const Index3 count = (layout.valid_shape(page) + grid.factor() - Index3(1)) / grid.factor();
    for_each_index(first, first + count, [&](Index3 block) {
      bool wall = false;
      bool anchor = true;
      for_each_index(grid.first_of(block), grid.first_of(block) + grid.size_of(block), [&](Index3 voxel) {
        const Constraint constraint = constraints.at(voxel);
        wall = wall || constraint == Constraint::wall;
        anchor = anchor && constraint == Constraint::anchor;
      });
      if (wall) walls.push_back(block);
      if (anchor) anchors.push_back(block);
    });
  }
  Constraints result(grid.coarse().size);
  result.set(walls, Constraint::wall);
  result.set(anchors, Constraint::anchor);
  return result;
}

Parameters coarsened(const Parameters& parameters, const CoarseGrid& grid) {
  Parameters result = parameters;
  const double data = grid.scale() * parameters.alpha;
  result.alpha = data / (data + 1.0 - parameters.alpha);
  return result;
}

double velocity_factor(const Parameters& parameters, const CoarseGrid& grid) {
  return grid.scale() / (grid.scale() * parameters.alpha + 1.0 - parameters.alpha);
}

Field refined(const Field& phi, const CoarseGrid& grid, double band, Index3 page_shape, int threads) {
  Field fine = Field::empty(grid.fine(), band, page_shape);
  Refiner(phi, grid, fine).run(threads);
  fine.store_between();
  return fine;
}

}  // namespace tidemark::solver
