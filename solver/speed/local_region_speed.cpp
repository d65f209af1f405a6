#include "solver/speed/local_region_speed.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "core/index_walk.h"

namespace tidemark::solver {
namespace {

void multiply(std::vector<float>& values, const std::vector<float>& by) {
  std::transform(values.begin(), values.end(), by.begin(), values.begin(), std::multiplies<>());
}

// Sums over the boxes around the voxels of a box.
struct BoxSums {
  Block values;
  Block squares;
  Block inside;         // how many voxels are inside
  Block inside_values;  // the sum of those
};

// D between the means is the distance to each of them, as in the global form. Where the means differ by less
// than noise does, the noise's variance stands for theirs, so that it does not become speed.
double speed(double value, double voxels, double sum, double squares, double inside, double inside_sum) {
  if (inside == 0.0 || inside == voxels) return 0.0;
  const double mean_inside = inside_sum / inside;
  const double mean_outside = (sum - inside_sum) / (voxels - inside);
  const double apart = mean_inside - mean_outside;
  const double mean = sum / voxels;
  const double scale = std::max(apart * apart, squares / voxels - mean * mean);
  if (!(scale > 0.0)) return 0.0;
  return std::clamp(apart * (2.0 * value - mean_inside - mean_outside) / scale, -1.0, 1.0);
}

}  // namespace

LocalRegionSpeed::LocalRegionSpeed(std::shared_ptr<const Volume> source, Index3 reach, float level,
                                   std::shared_ptr<const InsideMask> inside, std::vector<bool> changed)
    : source_(std::move(source)),
      reach_(reach),
      voxels_(static_cast<double>(grown({}, reach).voxels())),
      level_(level),
      inside_(std::move(inside)),
      changed_(std::move(changed)) {}

void LocalRegionSpeed::evaluate(const VoxelBox& box, double* speeds) const {
  std::fill_n(speeds, box.voxels(), 0.0);
  if (inside_ == nullptr) return;
  const VoxelBox around = grown(box, reach_);
  BoxSums sums;
  sums.inside = inside_->values_in(around);
  const auto [none, all] = std::minmax_element(sums.inside.values.begin(), sums.inside.values.end());
  if (*none == *all) return;  // the surface is far

  sums.values = values_in(*source_, around);
  for (float& value : sums.values.values) value -= level_;
  sums.squares = sums.values;
  multiply(sums.squares.values, sums.values.values);
  sums.inside_values = sums.values;
  multiply(sums.inside_values.values, sums.inside.values);
  for (Block* block : {&sums.values, &sums.squares, &sums.inside, &sums.inside_values})
    sum_boxes(*block, reach_);

  const Block own = values_in(*source_, box);
  for (std::size_t i = 0; i < own.values.size(); ++i) {
    speeds[i] =
        speed(static_cast<double>(own.values[i] - level_), voxels_,
              static_cast<double>(sums.values.values[i]), static_cast<double>(sums.squares.values[i]),
              static_cast<double>(sums.inside.values[i]), static_cast<double>(sums.inside_values.values[i]));
  }
}

std::shared_ptr<const SpeedFunction> LocalRegionSpeed::following(const Field& phi) const {
  auto inside = std::make_shared<const InsideMask>(phi);
  std::vector<bool> changed;
  if (inside_ != nullptr) {
    changed = inside->changes_from(*inside_);
    if (std::find(changed.begin(), changed.end(), true) == changed.end()) return nullptr;
  }
  return std::make_shared<LocalRegionSpeed>(source_, reach_, level_, std::move(inside), std::move(changed));
}

bool LocalRegionSpeed::is_as_before(const VoxelBox& box) const {
  if (changed_.empty()) return false;
  const PageLayout& layout = inside_->layout();
  const VoxelBox around = grown(box, reach_);
  const Index3 last_voxel = layout.domain_size() - Index3(1);
  const Index3 first = glm::clamp(around.first, Index3(0), last_voxel);
  const Index3 last = glm::clamp(around.first + around.size - Index3(1), Index3(0), last_voxel);
  return all_pages(layout, first, last + Index3(1), [&](Index3 page) {
    return !changed_[static_cast<std::size_t>(layout.page_number(page))];
  });
}

}  // namespace tidemark::solver
