// phi as a value: a sparse copy of the level set that every executor can give and take.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/paging/page_layout.h"
#include "core/paging/shared_pages.h"
#include "core/volume.h"

namespace tidemark::solver {

// phi > 0 inside, in units of the smallest voxel spacing, clamped to [-band, band].
struct Field {
  using Kind = SharedPages::Kind;  // a page that is not stored is +band or -band throughout

  Geometry geometry;
  double band = 2.5;  // W
  PageLayout layout;
  SharedPages pages;  // of layout; padding holds anything

  [[nodiscard]] float at(Index3 voxel) const {
    const VirtualAddress address = layout.translate(voxel);
    const float* const values = pages.values(address.page);
    return values == nullptr ? constant(address.page) : values[address.offset];
  }
  // Of a page that is not stored: +band or -band.
  [[nodiscard]] float constant(std::int64_t page) const {
    return static_cast<float>(pages.kind(page) == Kind::inside ? band : -band);
  }
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

  // Values in voxel order; pages that are +band or -band throughout are not stored, but for store_between().
  static Field from_dense(const Geometry& geometry, std::span<const float> values, double band,
                          Index3 page_shape = kDefaultPageShape);
  // What a page is, layout.voxels_per_page() values in [-band, band]. One that is +band or -band throughout
  // is not stored.
  void store_page(std::int64_t page, std::span<const float> values);
  // Stores one of any two pages between which the surface lies: executors look for it on stored pages.
  void store_between();
  // A stored page. Where it holds these values already, to the last bit, it stays where it lies.
  void update_page(std::int64_t page, const float* values);
};

// Whether they have the same pages to the last bit, padding included.
[[nodiscard]] bool same_pages(const Field& a, const Field& b);

}  // namespace tidemark::solver
