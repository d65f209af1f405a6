// Walls and anchors: voxels that the surface may never enclose, and voxels that it always encloses.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "core/volume.h"
#include "solver/field.h"
#include "solver/paging/page_layout.h"
#include "solver/sphere.h"

namespace tidemark::solver {

enum class Constraint : std::uint8_t { none = 0, wall = 1, anchor = 2 };

// phi <= -kConstraintDepth in a wall and phi >= kConstraintDepth in an anchor, in units of the smallest
// spacing: the surface runs beside the voxel and not through it.
inline constexpr float kConstraintDepth = 0.5F;
// phi of a voxel, taken to its limit.
template <class Real>
[[nodiscard]] Real limited(Constraint constraint, Real phi) {
  if (constraint == Constraint::wall) return std::min(phi, -static_cast<Real>(kConstraintDepth));
  if (constraint == Constraint::anchor) return std::max(phi, static_cast<Real>(kConstraintDepth));
  return phi;
}

// Kept by pages of 8^3 voxels: memory follows what is constrained, not the volume.
class Constraints {
 public:
  static constexpr int kPageVoxels = 512;
  // The constraints of a page's voxels, x fastest.
  using Page = std::array<Constraint, kPageVoxels>;

  Constraints() = default;
  explicit Constraints(Index3 grid_size);

  [[nodiscard]] const PageLayout& layout() const { return layout_; }
  [[nodiscard]] Constraint at(Index3 voxel) const;
  // Null: the page has none. Pages are shared with the copies of this object, and never change.
  [[nodiscard]] const Page* page(std::int64_t virtual_page) const {
    return pages_[static_cast<std::size_t>(virtual_page)].get();
  }
  [[nodiscard]] bool empty() const { return constrained_pages_ == 0; }
  [[nodiscard]] std::int64_t count(Constraint what) const;  // voxels

  // Sets the voxels of a mask on the same grid (not 0), or those whose centres are within a sphere; with
  // Constraint::none they are free again.
  void set(const Mask& mask, Constraint what);
  void set(const Geometry& geometry, const Sphere& sphere, Constraint what);

  bool operator==(const Constraints& other) const;

 private:
  void replace(std::int64_t virtual_page, const Page& page);
  void set(const std::function<bool(Index3)>& chosen, Index3 first, Index3 last, Constraint what);

  PageLayout layout_;
  std::vector<std::shared_ptr<const Page>> pages_;
  std::int64_t constrained_pages_ = 0;
};

// Takes phi to the limits of the constraints on its grid; pages become resident as they need to.
void constrain(Field& phi, const Constraints& constraints);

}  // namespace tidemark::solver
