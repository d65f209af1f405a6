// phi as a value: a sparse copy of the level set that every executor can give and take.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/volume.h"
#include "solver/paging/page_layout.h"

namespace tidemark::solver {

// phi > 0 inside, in units of the smallest voxel spacing, clamped to [-band, band].
struct Field {
  // A table entry that is not the index of a page: the whole page is +band or -band.
  static constexpr std::int32_t kOutside = -1;
  static constexpr std::int32_t kInside = -2;

  Geometry geometry;
  double band = 2.5;  // W
  PageLayout layout;
  std::vector<std::int32_t> table;  // a virtual page's index in `pages`, or kOutside or kInside
  std::vector<float> pages;         // layout.voxels_per_page() values a page; padding holds anything

  [[nodiscard]] float at(Index3 voxel) const;
  [[nodiscard]] std::int64_t resident_pages() const;
  [[nodiscard]] bool has_inside() const;  // phi > 0 in a voxel

  [[nodiscard]] std::vector<float> dense() const;  // in voxel order
  [[nodiscard]] Volume to_volume() const;          // a float volume, for saving and for the surface
  [[nodiscard]] Mask mask() const;                 // phi > 0

  // Fails (ErrorKind::usage) unless this is phi on that grid with that band.
  [[nodiscard]] Status check_fits(const Geometry& grid, double wanted_band) const;

  // All outside.
  static Field empty(const Geometry& geometry, double band, Index3 page_shape = kDefaultPageShape);
  // The same phi in pages of another shape, clamped to another band. Where it is as far from the surface as
  // the old band reaches it is as far as the new one does.
  [[nodiscard]] Field repaged(double new_band, Index3 page_shape) const;

  // Values in voxel order; pages that are +band or -band throughout are not stored.
  static Field from_dense(const Geometry& geometry, std::span<const float> values, double band,
                          Index3 page_shape = kDefaultPageShape);
  // What a page is, layout.voxels_per_page() values in [-band, band]. A resident page gets its place after
  // all that are there; one that is +band or -band throughout is not stored.
  void store_page(std::int64_t page, std::span<const float> values);
};

}  // namespace tidemark::solver
