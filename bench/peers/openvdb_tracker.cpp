// OpenVDB's LevelSetTracker, moved by our equation.
#include <openvdb/math/Stencils.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Dense.h>
#include <openvdb/tools/LevelSetTracker.h>
#include <openvdb/tools/SignedFloodFill.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "bench/peers/contestants.h"
#include "solver/model.h"
#include "solver/speed/tent_speed.h"

namespace tidemark::bench {
namespace {

using openvdb::FloatGrid;
using Tracker = openvdb::tools::LevelSetTracker<FloatGrid>;

// As OpenVDB's own LEVEL_SET_HALF_WIDTH, in voxels.
constexpr float kHalfWidth = 3.0F;

float square(float value) {
  return value * value;
}

// A step of data and curvature speed on the active voxels, then the tracker's: one layer more, one
// normalisation of first order (the cheapest it has, in the place of our rescaling term), trim and prune.
class OpenVdbTracker final : public Contestant {
 public:
  explicit OpenVdbTracker(const Problem& problem)
      : problem_(problem), threads_(tbb::global_control::max_allowed_parallelism, kThreads) {
    solver::Parameters unscaled = problem.parameters;
    unscaled.rescaling_term = false;
    const solver::TentSpeed speed(problem.source, unscaled);
    const solver::Model model(problem.source->geometry, unscaled, speed);
    constants_ = model.constants<float>();
    tent_ = solver::tent_of(unscaled);

    std::vector<float> start = start_distance(problem, kHalfWidth);
    for (float& value : start) value = -value;
    const Index3 size = problem.source->geometry.size;
    const openvdb::CoordBBox box(
        {0, 0, 0}, openvdb::Coord(coordinate(size.x - 1), coordinate(size.y - 1), coordinate(size.z - 1)));
    grid_ = FloatGrid::create(kHalfWidth);
    grid_->setGridClass(openvdb::GRID_LEVEL_SET);
    const openvdb::tools::Dense<float, openvdb::tools::LayoutXYZ> dense(box, start.data());
    openvdb::tools::copyFromDense(dense, *grid_, 0.0F);
    openvdb::tools::signedFloodFill(grid_->tree());
    tracker_ = std::make_unique<Tracker>(*grid_);
    tracker_->setSpatialScheme(openvdb::math::FIRST_BIAS);
    tracker_->setTemporalScheme(openvdb::math::TVD_RK1);
    tracker_->setNormCount(1);
    tracker_->prune();
  }

  Result<Cost> advance(std::int64_t steps) override {
    const auto start = std::chrono::steady_clock::now();
    for (std::int64_t i = 0; i < steps; ++i) {
      move();
      tracker_->track();
    }
    return Cost{steps, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count()};
  }

  Mask finish() override {
    const Geometry& geometry = problem_.source->geometry;
    Mask mask{geometry, {}};
    mask.voxels.reserve(static_cast<std::size_t>(geometry.voxel_count()));
    const auto accessor = grid_->getConstAccessor();
    for (std::int64_t k = 0; k < geometry.size.z; ++k) {
      for (std::int64_t j = 0; j < geometry.size.y; ++j) {
        for (std::int64_t i = 0; i < geometry.size.x; ++i) {
          const openvdb::Coord voxel(coordinate(i), coordinate(j), coordinate(k));
          mask.voxels.push_back(accessor.getValue(voxel) < 0.0F ? 1 : 0);
        }
      }
    }
    return mask;
  }

 private:
  using Stencil = openvdb::math::CurvatureStencil<FloatGrid>;

  static openvdb::Int32 coordinate(std::int64_t index) { return static_cast<openvdb::Int32>(index); }

  // D at a voxel; -1 outside the volume.
  [[nodiscard]] float data_speed(const openvdb::Coord& voxel) const {
    const Geometry& geometry = problem_.source->geometry;
    const Index3 index(voxel.x(), voxel.y(), voxel.z());
    if (!geometry.contains(index)) return -1.0F;
    const float value = problem_.values[static_cast<std::size_t>(geometry.offset(index))];
    const double peak_to_floor = tent_.peak - tent_.slope * std::abs(double{value} - tent_.target);
    return static_cast<float>(std::max(tent_.floor, peak_to_floor));
  }

  // phi < 0 inside: the surface grows where phi falls.
  static float upwind_gradient(const Stencil& s, bool grows) {
    const float centre = s.getValue(0);
    float sum = 0.0F;
    for (unsigned axis = 0; axis < 3; ++axis) {
      const float behind = centre - s.getValue(1 + 2 * axis);
      const float ahead = s.getValue(2 + 2 * axis) - centre;
      sum += grows ? square(std::max(behind, 0.0F)) + square(std::min(ahead, 0.0F))
                   : square(std::min(behind, 0.0F)) + square(std::max(ahead, 0.0F));
    }
    return std::sqrt(sum);
  }

  void move() {
    auto& leaves = tracker_->leafs();
    leaves.rebuildAuxBuffers(1);
    tbb::parallel_for(leaves.leafRange(), [&](const Tracker::LeafRange& range) {
      Stencil stencil(*grid_);
      for (auto leaf = range.begin(); leaf; ++leaf) {
        float* next = leaf.buffer(1).data();
        for (auto voxel = leaf->cbeginValueOn(); voxel; ++voxel) {
          stencil.moveTo(voxel);
          const float data = constants_.data_weight * data_speed(voxel.getCoord());
          // OpenVDB's mean curvature is half the sum of the principal ones.
          const float bend = constants_.curvature_weight * 2.0F * stencil.meanCurvatureNormGrad();
          next[voxel.pos()] = stencil.getValue(0) +
                              constants_.time_step * (bend - data * upwind_gradient(stencil, data > 0.0F));
        }
      }
    });
    leaves.swapLeafBuffer(1);
    leaves.removeAuxBuffers();
  }

  const Problem& problem_;
  tbb::global_control threads_;
  solver::StepConstants<float> constants_{};
  solver::Tent tent_;
  FloatGrid::Ptr grid_;
  std::unique_ptr<Tracker> tracker_;
};

}  // namespace

ContestantKind openvdb_tracker() {
  ContestantKind kind;
  kind.name = "openvdb";
  kind.description = "OpenVDB level-set tracker, 2 threads";
  kind.make = [](const Problem& problem) -> Result<std::unique_ptr<Contestant>> {
    openvdb::initialize();
    return std::make_unique<OpenVdbTracker>(problem);
  };
  return kind;
}

}  // namespace tidemark::bench
