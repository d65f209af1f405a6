#include "solver/surface_places.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <unordered_map>

#include "core/index_walk.h"

namespace tidemark::solver {
namespace {

glm::dvec3 into_grid(const Field& phi, glm::dvec3 place) {
  return glm::clamp(place, glm::dvec3(0.0), glm::dvec3(phi.geometry.size - Index3(1)));
}

bool is_inside(float phi) {
  return phi > 0.0F;
}

// Per voxel of each axis.
glm::dvec3 gradient_at(const Field& phi, glm::dvec3 place) {
  constexpr double kHalf = 0.5;
  glm::dvec3 gradient(0.0);
  for (int axis = 0; axis < 3; ++axis) {
    glm::dvec3 step(0.0);
    step[axis] = kHalf;
    gradient[axis] = phi_at(phi, place + step) - phi_at(phi, place - step);
  }
  return gradient;
}

// Keeps places that are far enough from those that were kept before. A cube with a side of that distance has
// the place that was kept in it last.
class Thinned {
 public:
  explicit Thinned(double apart_mm) : apart_mm_(apart_mm) {}

  void add(glm::dvec3 place, glm::dvec3 place_mm) {
    const Index3 cube(glm::floor(place_mm / apart_mm_));
    if (is_near(cube, place_mm)) return;  // mostly
    const auto is_far = [&](Index3 other) { return !is_near(other, place_mm); };
    if (!all_indices(cube - Index3(1), cube + Index3(2), is_far)) return;
    kept_[key(cube)] = place_mm;
    places.push_back(place);
  }

  std::vector<glm::dvec3> places;

 private:
  static std::uint64_t key(Index3 cube) {
    constexpr std::uint64_t kMask = (1ULL << 21U) - 1U;
    return (static_cast<std::uint64_t>(cube.x) & kMask) |
           (static_cast<std::uint64_t>(cube.y) & kMask) << 21U |
           (static_cast<std::uint64_t>(cube.z) & kMask) << 42U;
  }
  [[nodiscard]] bool is_near(Index3 cube, glm::dvec3 place_mm) const {
    const auto kept = kept_.find(key(cube));
    return kept != kept_.end() && glm::distance(kept->second, place_mm) < apart_mm_;
  }

  double apart_mm_;
  std::unordered_map<std::uint64_t, glm::dvec3> kept_;
};

bool meets(const Field& phi, std::int64_t page, const PlaneSlab& slab) {
  const glm::dvec3 half = 0.5 * glm::dvec3(phi.layout.page_shape());
  const glm::dvec3 middle_mm =
      phi.geometry.to_patient(glm::dvec3(phi.layout.first_voxel(page)) + half - glm::dvec3(0.5));
  const double radius_mm = glm::length((half + glm::dvec3(0.5)) * phi.geometry.spacing_mm);
  return std::abs(glm::dot(slab.normal, middle_mm) - slab.offset_mm) <= radius_mm + slab.reach_mm;
}

// Calls visit(place) for each crossing of phi = 0 between a voxel of a stored page and the one after it
// along an axis.
template <class Visit>
void for_each_crossing(const Field& phi, std::int64_t page, Visit visit) {
  const Index3 shape = phi.layout.page_shape();
  const Index3 strides(1, shape.x, shape.x * shape.y);
  const Index3 first = phi.layout.first_voxel(page);
  const Index3 valid = phi.layout.valid_shape(page);
  const float* const values = phi.pages.values(page);
  for_each_index(Index3(0), valid, [&](Index3 here) {
    const float* value = values + number_in(shape, here);
    for (int axis = 0; axis < 3; ++axis) {
      Index3 next = first + here;
      if (++next[axis] >= phi.geometry.size[axis]) continue;
      const float there = here[axis] + 1 < shape[axis] ? value[strides[axis]] : phi.at(next);
      if (is_inside(*value) == is_inside(there)) continue;
      glm::dvec3 place(first + here);
      place[axis] += *value / (*value - there);
      visit(place);
    }
  });
}

}  // namespace

double phi_at(const Field& phi, glm::dvec3 place) {
  const glm::dvec3 inside = into_grid(phi, place);
  const glm::dvec3 first = glm::floor(inside);
  const glm::dvec3 share = inside - first;
  double sum = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const Index3 step(corner & 1, corner >> 1 & 1, corner >> 2 & 1);
    const glm::dvec3 weights = glm::mix(glm::dvec3(1.0) - share, share, glm::dvec3(step));
    const double weight = weights.x * weights.y * weights.z;
    if (weight > 0.0) sum += weight * phi.at(Index3(first) + step);
  }
  return sum;
}

std::optional<glm::dvec3> surface_along(const Field& phi, glm::dvec3 place, glm::dvec3 way, double reach) {
  constexpr double kStride = 0.25;
  constexpr int kHalvings = 24;
  const bool inside = phi_at(phi, place) > 0.0;
  const auto is_other = [&](double at) { return (phi_at(phi, place + at * way) > 0.0) != inside; };
  const auto strides = static_cast<std::int64_t>(reach / kStride);
  for (std::int64_t i = 1; i <= strides; ++i) {
    const double far = kStride * static_cast<double>(i);
    for (const double side : {far, -far}) {
      if (!is_other(side)) continue;
      double near = side - std::copysign(kStride, side);
      double beyond = side;
      for (int halving = 0; halving < kHalvings; ++halving) {
        const double middle = 0.5 * (near + beyond);
        (is_other(middle) ? beyond : near) = middle;
      }
      return into_grid(phi, place + beyond * way);
    }
  }
  return std::nullopt;
}

std::optional<glm::dvec3> surface_near(const Field& phi, glm::dvec3 place, double reach) {
  const glm::dvec3 gradient = gradient_at(phi, place);
  if (const double length = glm::length(gradient); length > 0.0)
    return surface_along(phi, place, gradient / length, reach);
  std::optional<glm::dvec3> nearest;
  for (int code = 14; code < 27; ++code) {  // one of each pair of opposite ways
    const glm::dvec3 way(code % 3 - 1, code / 3 % 3 - 1, code / 9 - 1);
    const auto found = surface_along(phi, place, glm::normalize(way), reach);
    if (found && (!nearest || glm::distance(*found, place) < glm::distance(*nearest, place))) nearest = found;
  }
  return nearest;
}

std::vector<glm::dvec3> surface_places(const Field& phi, const std::optional<PlaneSlab>& slab,
                                       double apart_mm, const std::stop_token& stop) {
  Thinned thinned(apart_mm);
  const auto add = [&](glm::dvec3 place) {
    const glm::dvec3 place_mm = phi.geometry.to_patient(place);
    if (!slab || std::abs(glm::dot(slab->normal, place_mm) - slab->offset_mm) <= slab->reach_mm)
      thinned.add(place, place_mm);
  };
  for (std::int64_t page = 0; page < phi.layout.page_count() && !stop.stop_requested(); ++page) {
    if (!phi.pages.is_stored(page) || (slab && !meets(phi, page, *slab))) continue;
    for_each_crossing(phi, page, add);
  }
  return std::move(thinned.places);
}

std::vector<glm::dvec3> surface_places_in(const Field& phi, std::span<const std::int64_t> pages,
                                          double apart_mm, const std::stop_token& stop) {
  Thinned thinned(apart_mm);
  const auto add = [&](glm::dvec3 place) { thinned.add(place, phi.geometry.to_patient(place)); };
  for (const std::int64_t page : pages) {
    if (stop.stop_requested()) break;
    // One that has become constant since has no surface.
    if (phi.pages.is_stored(page)) for_each_crossing(phi, page, add);
  }
  return std::move(thinned.places);
}

}  // namespace tidemark::solver
