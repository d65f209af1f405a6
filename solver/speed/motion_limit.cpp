#include "solver/speed/motion_limit.h"

#include <algorithm>

#include "solver/distance_transform.h"
#include "solver/speed/distance_map.h"

namespace tidemark::solver {
namespace {

using Page = Constraints::Page;

// The constraints of a page's voxels by their index; voxels beyond the volume have none.
template <class At>
Page page_of(Index3 valid, const At& at) {
  Page page{};
  for (std::int64_t i = 0; i < Constraints::kPageVoxels; ++i) {
    const bool inside = i % 8 < valid.x && i / 8 % 8 < valid.y && i / 64 < valid.z;
    if (inside) page[static_cast<std::size_t>(i)] = at(i);
  }
  return page;
}

// The limit that the surface may meet in a voxel; where both are near, that on the side of the mask's
// surface.
Constraint limit_at(double distance, double within) {
  const Constraint upper = at_most(distance + within);
  const Constraint lower = at_least(distance - within);
  if (upper == Constraint::none || lower == Constraint::none) {
    return upper == Constraint::none ? lower : upper;
  }
  return distance < 0.0 ? upper : lower;
}

// Voxels that are not stored are farther from the mask's surface than any limit.
std::shared_ptr<const Constraints> constraints_of(const Field& distance, double within) {
  auto constraints = std::make_shared<Constraints>(distance.geometry.size);
  const PageLayout& layout = distance.layout;
  std::int64_t even_page[2] = {-1, -1};  // whose voxels are all walls, all anchors
  for (std::int64_t number = 0; number < layout.page_count(); ++number) {
    const float* const values = distance.pages.values(number);
    const bool is_outside = distance.pages.kind(number) == Field::Kind::outside;
    const Index3 valid = layout.valid_shape(number);
    std::int64_t& even = even_page[is_outside ? 0 : 1];
    const bool is_even = values == nullptr && valid == kDefaultPageShape;
    if (is_even && even >= 0) {
      constraints->repeat_page(number, even);
      continue;
    }
    const auto at = [&](std::int64_t i) {
      if (values == nullptr) return is_outside ? Constraint::wall : Constraint::anchor;
      return limit_at(static_cast<double>(values[i]), within);
    };
    constraints->set_page(number, page_of(valid, at));
    if (is_even) even = number;
  }
  return constraints;
}

}  // namespace

const MotionLimit::Made& MotionLimit::made() const {
  std::call_once(once_, [this] {
    const glm::dvec3& spacing = mask_->geometry().spacing_mm;
    const double within = within_mm_ / std::min({spacing.x, spacing.y, spacing.z});
    // Beyond the limit and what is written of it, nothing needs to be known.
    Field distance = distance_transform(inside_of(*mask_), within + 2.0 * static_cast<double>(kLimitReach));
    made_.constraints = constraints_of(distance, within);
    made_.change = distance_map(std::move(distance), within);
  });
  return made_;
}

}  // namespace tidemark::solver
