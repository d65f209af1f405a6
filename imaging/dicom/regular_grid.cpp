#include "imaging/dicom/regular_grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "imaging/dicom/slice_places.h"

namespace tidemark::imaging {
namespace {

// Gantries are tilted by at most 30 degrees; beyond this slices have little to do with each other.
constexpr double kLargestTilt = 45.0;
// The most voxels of a grid for each voxel of the slices: most of a volume must be measured, and headers
// cannot ask for any amount of memory.
constexpr double kMostVoxels = 4.0;
// In distances of slices and of pixels: nearer slices count as being there.
constexpr double kHere = 1e-3;
constexpr std::size_t kMostGapsNamed = 8;

// One planning of one grid.
class GridPlanner {
 public:
  GridPlanner(const ImageStack& stack, const GridPolicy& policy)
      : stack_(stack),
        policy_(policy),
        places_(places_of(stack.positions_mm, stack.axes)),
        tilt_(tilt_of(places_)),
        scale_(scale_of(places_)) {}

  GridPlan plan();

 private:
  using Kind = SliceScale::Kind;

  [[nodiscard]] bool moves_back() const {
    return tilt_.degrees > 0.0 && policy_.tilt == GridPolicy::Tilt::correct;
  }
  [[nodiscard]] SliceShare share(std::size_t slice, double weight) const {
    return {static_cast<std::int64_t>(slice), weight, shifts_[slice]};
  }
  [[nodiscard]] std::string name_gap(std::size_t k) const;
  [[nodiscard]] std::string name_unevenness() const;
  void refuse_tilt();
  void refuse_gaps();
  void set_shifts();
  void set_geometry();
  void set_slices();
  void tell_tilt();
  void tell_gaps();

  const ImageStack& stack_;
  const GridPolicy& policy_;
  SlicePlaces places_;
  SliceTilt tilt_;
  SliceScale scale_;
  std::vector<std::size_t> gaps_;   // slices after which others are missing
  std::vector<glm::dvec2> shifts_;  // of each slice in the grid, in pixels
  GridPlan plan_;
};

// "2 slices are missing between a and b".
std::string GridPlanner::name_gap(std::size_t k) const {
  const auto missing = scale_.missing_after(k);
  return fmt::format("{} slice{} missing between {} and {}", missing, missing == 1 ? " is" : "s are",
                     stack_.names[k], stack_.names[k + 1]);
}

// The first step that is unlike the usual one, or, where only the sum of all is wrong, the slice.
std::string GridPlanner::name_unevenness() const {
  for (std::size_t k = 0; k < places_.last(); ++k) {
    if (is_distance(places_.step(k), scale_.step_mm)) continue;
    return fmt::format("uneven slice distances: {} and {} are {:.3f} mm apart, others {:.3f} mm",
                       stack_.names[k], stack_.names[k + 1], places_.step(k), scale_.step_mm);
  }
  const double mean = places_.along.back() / static_cast<double>(places_.last());
  const auto beside = [&](std::size_t k) {
    return std::abs(places_.along[k] - mean * static_cast<double>(k));
  };
  std::size_t farthest = 0;
  for (std::size_t k = 0; k <= places_.last(); ++k) {
    if (beside(k) > beside(farthest)) farthest = k;
  }
  return fmt::format(
      "uneven slice distances: {} lies {:.3f} mm from its place in an even series of {:.3f} mm",
      stack_.names[farthest], beside(farthest), mean);
}

void GridPlanner::refuse_tilt() {
  const double sideways = glm::length(places_.sideways.back());
  if (tilt_.uneven) {
    const std::size_t k = *tilt_.uneven;
    plan_.refusal = fmt::format(
        "the images move sideways unevenly: from {} to {} by {:.3f} mm in {:.3f} mm, over all by {:.3f} mm "
        "in "
        "{:.3f} mm",
        stack_.names[k], stack_.names[k + 1], glm::length(places_.sideways[k + 1] - places_.sideways[k]),
        places_.step(k), sideways, places_.along.back());
  } else if (tilt_.degrees > kLargestTilt) {
    plan_.refusal = fmt::format(
        "from {} to {} the images move {:.3f} mm sideways, {:.1f} degrees off their normal: more than any "
        "gantry is tilted",
        stack_.names.front(), stack_.names.back(), sideways, tilt_.degrees);
  }
}

// A question only where the answer could be a grid.
void GridPlanner::refuse_gaps() {
  const bool can_be_filled = plan_.refusal.empty();
  if (scale_.kind == Kind::missing) {
    const std::string more = gaps_.size() > 1 ? fmt::format(", and in {} more place{}", gaps_.size() - 1,
                                                            gaps_.size() == 2 ? "" : "s")
                                              : "";
    const std::string first = name_gap(gaps_.front());
    plan_.refusal = fmt::format("{}: they are {:.3f} mm apart, others {:.3f} mm{}", first,
                                places_.step(gaps_.front()), scale_.step_mm, more);
    const bool is_one = gaps_.size() == 1 && scale_.missing_after(gaps_.front()) == 1;
    plan_.question = fmt::format("{}{}. Fill {} by interpolation?", first, more, is_one ? "it" : "them");
  } else {
    plan_.refusal = name_unevenness();
    plan_.question = fmt::format("{}. Make {} slices at {:.3f} mm of them by interpolation?", plan_.refusal,
                                 scale_.slices(), scale_.step_mm);
    plan_.question.front() = 'U';
  }
  if (!can_be_filled) plan_.question.clear();
}

// The grid begins at or just before the slice farthest to its low side, and has the first slice's pixels.
void GridPlanner::set_shifts() {
  shifts_.assign(places_.along.size(), glm::dvec2(0.0));
  if (!moves_back()) return;
  std::transform(places_.sideways.begin(), places_.sideways.end(), shifts_.begin(),
                 [&](glm::dvec2 sideways) { return sideways / stack_.spacing_mm; });
  glm::dvec2 low(0.0);
  for (const glm::dvec2& shift : shifts_) low = glm::min(low, shift);
  low = glm::floor(low + kHere);
  for (glm::dvec2& shift : shifts_) shift -= low;
}

void GridPlanner::set_geometry() {
  glm::dvec2 most(0.0);
  for (const glm::dvec2& shift : shifts_) most = glm::max(most, shift);
  const glm::dvec2 more = glm::ceil(most - kHere);
  const glm::dvec2 area = (glm::dvec2(stack_.size) + more) / glm::dvec2(stack_.size);
  const double growth = area.x * area.y * (scale_.places.back() + 1.0) / static_cast<double>(stack_.size.z);
  if (!(growth <= kMostVoxels)) {
    plan_.refusal = fmt::format(
        "a regular grid from {} to {} would have {:.1f} times as many voxels as the images (more than "
        "{:.0f})",
        stack_.names.front(), stack_.names.back(), growth, kMostVoxels);
    return;
  }
  Geometry& geometry = plan_.geometry;
  geometry.size = {stack_.size.x + std::llround(more.x), stack_.size.y + std::llround(more.y),
                   scale_.slices()};
  geometry.spacing_mm = glm::dvec3(stack_.spacing_mm, scale_.step_mm);
  geometry.direction = stack_.axes;
  const glm::dvec2 back = shifts_.front() * stack_.spacing_mm;
  geometry.origin_mm = stack_.positions_mm.front() - back.x * stack_.axes[0] - back.y * stack_.axes[1];
}

void GridPlanner::set_slices() {
  if (scale_.kind == Kind::even && !moves_back()) return;
  std::size_t before = 0;
  for (std::int64_t q = 0; q < scale_.slices(); ++q) {
    const auto place = static_cast<double>(q);
    while (before + 1 < places_.last() && scale_.places[before + 1] <= place) ++before;
    const double low = scale_.places[before];
    const double high = scale_.places[before + 1];
    // The last slice also covers half a step beyond it.
    if (place - low <= kHere) {
      plan_.slices.push_back({share(before, 1.0), share(before, 0.0)});
    } else if (high - place <= kHere) {
      plan_.slices.push_back({share(before + 1, 1.0), share(before + 1, 0.0)});
    } else {
      const double part = (place - low) / (high - low);
      plan_.slices.push_back({share(before, 1.0 - part), share(before + 1, part)});
    }
  }
}

void GridPlanner::tell_tilt() {
  if (tilt_.degrees == 0.0) return;
  if (!moves_back()) {
    plan_.warnings.push_back(fmt::format(
        "the gantry was tilted by {:.1f} degrees, and the slices keep their places: positions, and "
        "distances across slices, are sheared by as much",
        tilt_.degrees));
    return;
  }
  const Index3 size = plan_.geometry.size;
  plan_.changes.push_back(fmt::format(
      "gantry tilt of {:.1f} degrees corrected: slices are moved back within their planes, up to {:.2f} mm, "
      "and have {} x {} voxels for {} x {} pixels",
      tilt_.degrees, glm::length(places_.sideways.back()), size.x, size.y, stack_.size.x, stack_.size.y));
}

void GridPlanner::tell_gaps() {
  if (scale_.kind == Kind::uneven) {
    const auto mixed = std::count_if(plan_.slices.begin(), plan_.slices.end(),
                                     [](const GridSlice& slice) { return slice[1].weight > 0.0; });
    plan_.changes.push_back(
        fmt::format("{}: {} slices {:.3f} mm apart are made of {}, {} of them by interpolation between two",
                    name_unevenness(), scale_.slices(), scale_.step_mm, stack_.size.z, mixed));
  }
  for (std::size_t n = 0; n < std::min(gaps_.size(), kMostGapsNamed); ++n) {
    const std::size_t k = gaps_[n];
    const auto first = std::llround(scale_.places[k]) + 1;  // from 0; people count from 1
    const auto last = first + scale_.missing_after(k) - 1;
    const auto at = [&](std::int64_t slice) { return scale_.step_mm * static_cast<double>(slice); };
    plan_.changes.push_back(
        first == last
            ? fmt::format("slice {} of {} ({:.3f} mm from the first) is interpolated between {} and {}",
                          first + 1, scale_.slices(), at(first), stack_.names[k], stack_.names[k + 1])
            : fmt::format("slices {} to {} of {} ({:.3f} to {:.3f} mm from the first) are interpolated "
                          "between {} and {}",
                          first + 1, last + 1, scale_.slices(), at(first), at(last), stack_.names[k],
                          stack_.names[k + 1]));
  }
  if (gaps_.size() > kMostGapsNamed) {
    plan_.changes.push_back(
        fmt::format("slices are interpolated in {} more places", gaps_.size() - kMostGapsNamed));
  }
}

GridPlan GridPlanner::plan() {
  refuse_tilt();
  if (!plan_.refusal.empty()) return plan_;
  for (std::size_t k = 0; k < places_.last(); ++k) {
    if (scale_.missing_after(k) > 0) gaps_.push_back(k);
  }
  if (tilt_.degrees > 0.0) {
    plan_.tilt = fmt::format(
        "The gantry was tilted by {:.1f} degrees: from the first slice to the last, slices move {:.2f} mm "
        "sideways.",
        tilt_.degrees, glm::length(places_.sideways.back()));
  }
  set_shifts();
  set_geometry();
  if (scale_.kind != Kind::even && policy_.gaps == GridPolicy::Gaps::refuse) refuse_gaps();
  if (!plan_.refusal.empty()) {
    plan_.geometry = {};
    return plan_;
  }
  set_slices();
  tell_tilt();
  tell_gaps();
  return plan_;
}

GridPlan plan_of_one(const ImageStack& stack) {
  GridPlan plan;
  plan.geometry = {
      stack.size, {stack.spacing_mm, stack.thickness_mm}, stack.axes, stack.positions_mm.front()};
  return plan;
}

}  // namespace

GridPlan plan_regular_grid(const ImageStack& stack, const GridPolicy& policy) {
  if (stack.size.z == 1) return plan_of_one(stack);
  return GridPlanner(stack, policy).plan();
}

}  // namespace tidemark::imaging
