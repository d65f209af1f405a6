#include "solver/coarse_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/gtx/component_wise.hpp>
#include <vector>

namespace tidemark::solver {
namespace {

constexpr std::int64_t kSmallEnough = std::int64_t{1} << 21;  // voxels

template <class Visit>
void for_each_voxel(Index3 first, Index3 size, Visit visit) {
  for (std::int64_t k = first.z; k < first.z + size.z; ++k) {
    for (std::int64_t j = first.y; j < first.y + size.y; ++j) {
      for (std::int64_t i = first.x; i < first.x + size.x; ++i) visit(Index3(i, j, k));
    }
  }
}

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

// phi of a coarse grid at the voxels of one page of the fine grid after the other.
class PageRefiner {
 public:
  PageRefiner(const Field& coarse, const CoarseGrid& grid, Field& fine)
      : coarse_(coarse), grid_(grid), fine_(fine), limit_(static_cast<float>(fine.band)) {}

  void refine(std::int64_t page) {
    const Index3 first = fine_.layout.first_voxel(page);
    const Index3 valid = fine_.layout.valid_shape(page);
    for (int axis = 0; axis < 3; ++axis) place(axis, first[axis], valid[axis]);
    if (const auto constant = constant_around()) {
      fine_.pages.set_constant(page, *constant);
      return;
    }
    gather();
    interpolate(valid);
    fine_.store_page(page, values_);
  }

 private:
  using Axis = std::vector<Between>;

  void place(int axis, std::int64_t first, std::int64_t count) {
    Axis& places = places_[static_cast<std::size_t>(axis)];
    places.clear();
    for (std::int64_t voxel = first; voxel < first + count; ++voxel) {
      places.push_back(between(voxel, grid_.factor()[axis], grid_.coarse().size[axis]));
    }
    from_[axis] = places.front().low;
    size_[axis] = places.back().high - places.front().low + 1;
  }

  // What stands for the page where no stored page of the coarse phi reaches it.
  [[nodiscard]] std::optional<Field::Kind> constant_around() const {
    const Index3 shape = coarse_.layout.page_shape();
    const Index3 low = from_ / shape;
    const Index3 high = (from_ + size_ - Index3(1)) / shape;
    const Field::Kind one = kind_at(low);
    if (one == Field::Kind::stored) return std::nullopt;
    bool same = true;
    for_each_voxel(low, high - low + Index3(1), [&](Index3 page) { same = same && kind_at(page) == one; });
    return same ? std::optional(one) : std::nullopt;
  }
  [[nodiscard]] Field::Kind kind_at(Index3 page) const {
    return coarse_.pages.kind(coarse_.layout.page_number(page));
  }

  void gather() {
    block_.clear();
    for_each_voxel(from_, size_, [&](Index3 voxel) { block_.push_back(coarse_.at(voxel)); });
  }

  void interpolate(Index3 valid) {
    values_.assign(static_cast<std::size_t>(fine_.layout.voxels_per_page()), -limit_);
    const auto scale = static_cast<float>(grid_.scale());
    const Index3 shape = fine_.layout.page_shape();
    for_each_voxel(Index3(0), valid, [&](Index3 v) {
      const Between& x = places_[0][static_cast<std::size_t>(v.x)];
      const Between& y = places_[1][static_cast<std::size_t>(v.y)];
      const Between& z = places_[2][static_cast<std::size_t>(v.z)];
      const auto row = [&](std::int64_t j, std::int64_t k) {
        const std::int64_t start = size_.x * (j - from_.y + size_.y * (k - from_.z)) - from_.x;
        const float low = block_[static_cast<std::size_t>(start + x.low)];
        return low + x.weight * (block_[static_cast<std::size_t>(start + x.high)] - low);
      };
      const auto plane = [&](std::int64_t k) {
        const float low = row(y.low, k);
        return low + y.weight * (row(y.high, k) - low);
      };
      const float low = plane(z.low);
      const float phi = scale * (low + z.weight * (plane(z.high) - low));
      values_[static_cast<std::size_t>(number_in(shape, v))] = std::clamp(phi, -limit_, limit_);
    });
  }

  const Field& coarse_;
  const CoarseGrid& grid_;
  Field& fine_;
  float limit_;
  std::array<Axis, 3> places_;
  Index3 from_{0};  // the coarse voxels that take part
  Index3 size_{1};
  std::vector<float> block_;   // their phi, x fastest
  std::vector<float> values_;  // of the page
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
  for_each_voxel(Index3(0), {1, blocks.y, blocks.z}, [&](Index3 first) {
    std::fill(counts.begin(), counts.end(), 0);
    const Index3 size = grid.size_of(first);
    for_each_voxel(grid.first_of(first), {1, size.y, size.z}, [&](Index3 voxel) {
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
    for_each_voxel(first, count, [&](Index3 block) {
      bool wall = false;
      bool anchor = true;
      for_each_voxel(grid.first_of(block), grid.size_of(block), [&](Index3 voxel) {
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

Field refined(const Field& phi, const CoarseGrid& grid, double band, Index3 page_shape) {
  Field fine = Field::empty(grid.fine(), band, page_shape);
  PageRefiner refiner(phi, grid, fine);
  for (std::int64_t page = 0; page < fine.layout.page_count(); ++page) refiner.refine(page);
  return fine;
}

}  // namespace tidemark::solver
