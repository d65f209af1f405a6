#include "engine/surface_maps.h"

#include <algorithm>
#include <cmath>
#include <glm/gtx/component_wise.hpp>
#include <utility>

#include "core/index_walk.h"
#include "core/inside.h"
#include "solver/distance_transform.h"
#include "solver/speed/distance_map.h"

namespace tidemark::engine {
namespace {

constexpr double kSpacings = 3.0;
constexpr double kBeyond = 1.0;  // smallest spacings that the distances reach farther than the colours

double range_in_spacings(const Geometry& geometry) {
  return distance_range_mm(geometry) / glm::compMin(geometry.spacing_mm);
}

// The voxels that at least so many runs have inside.
Inside inside_of(const document::Agreement& runs, const Geometry& grid, int least) {
  return {grid, [&runs, grid, least](std::int64_t offset, std::span<std::uint8_t> voxels) {
            for (std::uint8_t& voxel : voxels) voxel = runs.count(grid.voxel_at(offset++)) >= least ? 1 : 0;
          }};
}

class SpreadMap final : public solver::SpeedFunction {
 public:
  SpreadMap(solver::Field outermost, solver::Field innermost, double within, double beside)
      : outermost_(std::move(outermost)),
        innermost_(std::move(innermost)),
        within_(within),
        beside_(beside) {}

  void evaluate(const solver::VoxelBox& box, double* share) const override {
    for_each_index(box.first, box.first + box.size, [&](Index3 voxel) { *share++ = at(voxel); });
  }

 private:
  [[nodiscard]] double at(Index3 voxel) const {
    const auto outer = static_cast<double>(outermost_.at(voxel));
    const auto inner = static_cast<double>(innermost_.at(voxel));
    // Beside a face between two voxels neither is on a surface: so near nothing is away from it.
    const double away = std::max({inner - beside_, -outer - beside_, 0.0});
    return std::min(2.0 * (outer - inner + away) / within_ - 1.0, 1.0);
  }

  solver::Field outermost_;
  solver::Field innermost_;
  double within_;  // in units of the smallest spacing
  double beside_;
};

}  // namespace

double distance_range_mm(const Geometry& geometry) {
  return std::ceil(kSpacings * glm::compMax(geometry.spacing_mm));
}

std::shared_ptr<const solver::SpeedFunction> truth_error_map(const BitMask& truth) {
  const double within = range_in_spacings(truth.geometry());
  return solver::distance_map(solver::distance_transform(tidemark::inside_of(truth), within + kBeyond),
                              within);
}

std::shared_ptr<const solver::SpeedFunction> spread_map(const document::Agreement& runs,
                                                        const Geometry& grid) {
  const double within = range_in_spacings(grid);
  const double beside = glm::compMax(grid.spacing_mm) / glm::compMin(grid.spacing_mm);
  const double band = within + beside + kBeyond;
  const auto distances = [&](int least) {
    return solver::distance_transform(inside_of(runs, grid, least), band);
  };
  return std::make_shared<SpreadMap>(distances(1), distances(runs.not_empty()), within, beside);
}

}  // namespace tidemark::engine
