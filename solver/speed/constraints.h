// Walls and anchors: voxels that the surface may never enclose, and voxels that it always encloses.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "core/bit_mask.h"
#include "core/paging/page_layout.h"
#include "core/paging/shared_pages.h"
#include "solver/field.h"
#include "solver/sphere.h"

namespace tidemark::solver {

// Beyond these three, a value is a limit of phi in steps: see at_most() and at_least().
enum class Constraint : std::uint8_t { none = 0, wall = 1, anchor = 2 };

// phi <= -kConstraintDepth in a wall and phi >= kConstraintDepth in an anchor, in units of the smallest
// spacing: the surface runs beside the voxel and not through it.
inline constexpr float kConstraintDepth = 0.5F;

// Limits that leave the surface a place between voxels, as resources/shaders/solver/speed/constraints.glsl
// has them, too: multiples of 1 / kLimitSteps from -kLimitReach to kLimitReach, which every band holds.
inline constexpr int kLimitSteps = 32;
inline constexpr float kLimitReach = 1.5F;
inline constexpr int kFirstAtMost = 3;
inline constexpr int kFirstAtLeast = 100;
static_assert(kFirstAtMost + 2 * static_cast<int>(kLimitReach * kLimitSteps) < kFirstAtLeast);
// phi is at most, or at least, that much, rounded to the side of the limit; none: beyond what phi may be.
[[nodiscard]] Constraint at_most(double phi);
[[nodiscard]] Constraint at_least(double phi);

// Whether phi has an upper or a lower limit.
[[nodiscard]] constexpr bool is_upper(Constraint constraint) {
  const int code = static_cast<int>(constraint);
  return constraint == Constraint::wall || (code >= kFirstAtMost && code < kFirstAtLeast);
}
[[nodiscard]] constexpr bool is_lower(Constraint constraint) {
  return constraint == Constraint::anchor || static_cast<int>(constraint) >= kFirstAtLeast;
}
// Of a constraint that is not none.
[[nodiscard]] constexpr float limit_of(Constraint constraint) {
  if (constraint == Constraint::wall) return -kConstraintDepth;
  if (constraint == Constraint::anchor) return kConstraintDepth;
  const int code = static_cast<int>(constraint);
  const int step = code - (code < kFirstAtLeast ? kFirstAtMost : kFirstAtLeast);
  return static_cast<float>(step) / kLimitSteps - kLimitReach;
}
// phi of a voxel, taken to its limit.
template <class Real>
[[nodiscard]] Real limited(Constraint constraint, Real phi) {
  if (constraint == Constraint::none) return phi;
  const Real limit = static_cast<Real>(limit_of(constraint));
  return is_upper(constraint) ? std::min(phi, limit) : std::max(phi, limit);
}

// Whether these constraints of a page's voxels let phi be all inside there, or all outside.
[[nodiscard]] bool allows_constant(const Constraint* page, bool inside);

// Kept by pages of 8^3 voxels, which copies share: memory follows what is constrained, not the volume.
class Constraints {
 public:
  static constexpr int kPageVoxels = 512;
  // The constraints of a page's voxels, x fastest.
  using Page = std::array<Constraint, kPageVoxels>;
  using Pages = BasicSharedPages<Constraint>;

  Constraints() = default;
  explicit Constraints(Index3 grid_size);

  [[nodiscard]] const PageLayout& layout() const { return layout_; }
  [[nodiscard]] Constraint at(Index3 voxel) const;
  // Those of a page's voxels, kPageVoxels of them, x fastest; null: it has none.
  [[nodiscard]] const Constraint* page(std::int64_t virtual_page) const {
    return pages_.values(virtual_page);
  }
  [[nodiscard]] const Pages& pages() const { return pages_; }
  [[nodiscard]] bool empty() const { return pages_.stored() == 0; }
  [[nodiscard]] std::int64_t count(Constraint what) const;  // voxels

  // Sets the voxels of a mask on the same grid, those whose centres are within a sphere, or those of
  // a list; with Constraint::none they are free again.
  void set(const BitMask& mask, Constraint what);
  void set(const Geometry& geometry, const Sphere& sphere, Constraint what);
  void set(const std::vector<Index3>& voxels, Constraint what);  // on the grid
  void set_page(std::int64_t virtual_page, const Page& page);
  // The page as another page is.
  void repeat_page(std::int64_t virtual_page, std::int64_t like) { pages_.repeat(virtual_page, like); }
  // With those of `other`, on the same grid, where this has none.
  [[nodiscard]] Constraints over(const Constraints& other) const;

  bool operator==(const Constraints& other) const;

 private:
  [[nodiscard]] Page copy_of(std::int64_t virtual_page) const;
  void set(const std::function<bool(Index3)>& chosen, Index3 first, Index3 last, Constraint what);

  PageLayout layout_;
  Pages pages_;
};

// Takes phi to the limits of the constraints on its grid; pages become resident as they need to.
void constrain(Field& phi, const Constraints& constraints);

}  // namespace tidemark::solver
