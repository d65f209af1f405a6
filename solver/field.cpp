#include "solver/field.h"

#include <algorithm>
#include <cstring>

#include "core/large_pages.h"
#include "core/paging/page_rows.h"

namespace tidemark::solver {

bool Field::has_inside() const {
  bool found = false;
  for (std::int64_t page = 0; page < layout.page_count() && !found; ++page) {
    const float* const values = pages.values(page);
    found = pages.kind(page) == Kind::inside;
    if (values == nullptr) continue;
    for_each_row(geometry, layout, page, [&](std::int64_t, std::int64_t length, std::int64_t index) {
      const float* row = values + index;
      found = found || std::any_of(row, row + length, [](float phi) { return phi > 0.0F; });
    });
  }
  return found;
}

Status Field::check_fits(const Geometry& grid, double wanted_band) const {
  if (geometry.size != grid.size) {
    return fail(ErrorKind::usage, "phi has {} x {} x {} voxels, the volume has {} x {} x {}", geometry.size.x,
                geometry.size.y, geometry.size.z, grid.size.x, grid.size.y, grid.size.z);
  }
  if (static_cast<float>(band) != static_cast<float>(wanted_band)) {
    return fail(ErrorKind::usage, "phi has a band of {} voxels, the level set one of {}", band, wanted_band);
  }
  return {};
}

std::vector<float> Field::dense() const {
  auto values = make_large_vector<float>(static_cast<std::size_t>(geometry.voxel_count()));
  for (std::int64_t page = 0; page < layout.page_count(); ++page) {
    const float* const stored = pages.values(page);
    for_each_row(geometry, layout, page, [&](std::int64_t offset, std::int64_t length, std::int64_t index) {
      float* row = values.data() + offset;
      if (stored == nullptr) {
        std::fill_n(row, length, constant(page));
      } else {
        std::copy_n(stored + index, length, row);
      }
    });
  }
  return values;
}

Volume Field::to_volume() const {
  Volume volume;
  volume.geometry = geometry;
  volume.voxels = dense();
  volume.description = "level set phi";
  return volume;
}

Mask Field::mask() const {
  Mask result{geometry, make_large_vector<std::uint8_t>(static_cast<std::size_t>(geometry.voxel_count()))};
  for (std::int64_t page = 0; page < layout.page_count(); ++page) {
    if (pages.kind(page) == Kind::outside) continue;
    const float* const stored = pages.values(page);
    for_each_row(geometry, layout, page, [&](std::int64_t offset, std::int64_t length, std::int64_t index) {
      std::uint8_t* row = result.voxels.data() + offset;
      if (stored == nullptr) {
        std::fill_n(row, length, std::uint8_t{1});
      } else {
        std::transform(stored + index, stored + index + length, row,
                       [](float phi) { return std::uint8_t(phi > 0.0F); });
      }
    });
  }
  return result;
}

Field Field::empty(const Geometry& geometry, double band, Index3 page_shape) {
  Field field;
  field.geometry = geometry;
  field.band = band;
  field.layout = PageLayout(geometry.size, page_shape);
  field.pages = SharedPages(field.layout.page_count(), field.layout.voxels_per_page());
  return field;
}

Field Field::from_dense(const Geometry& geometry, std::span<const float> values, double band,
                        Index3 page_shape) {
  Field field = empty(geometry, band, page_shape);
  const auto limit = static_cast<float>(band);
  std::vector<float> page_values(static_cast<std::size_t>(field.layout.voxels_per_page()), -limit);
  for (std::int64_t page = 0; page < field.layout.page_count(); ++page) {
    for_each_row(geometry, field.layout, page,
                 [&](std::int64_t offset, std::int64_t length, std::int64_t index) {
                   const float* row = values.data() + offset;
                   std::transform(row, row + length, page_values.data() + index,
                                  [limit](float phi) { return std::clamp(phi, -limit, limit); });
                 });
    field.store_page(page, page_values);
  }
  field.store_between();
  return field;
}

void Field::store_between() {
  const auto is_outside = [&](Index3 page) {
    return layout.contains_page(page) && pages.kind(layout.page_number(page)) == Kind::outside;
  };
  for (std::int64_t page = 0; page < layout.page_count(); ++page) {
    if (pages.kind(page) != Kind::inside) continue;
    const Index3 at = layout.page_coordinates(page);
    bool touches = false;
    for (int axis = 0; axis < 3; ++axis) {
      Index3 step(0);
      step[axis] = 1;
      touches = touches || is_outside(at - step) || is_outside(at + step);
    }
    if (touches) std::fill_n(pages.store(page), layout.voxels_per_page(), static_cast<float>(band));
  }
}

void Field::store_page(std::int64_t page, std::span<const float> values) {
  const auto limit = static_cast<float>(band);
  bool inside = true;
  bool outside = true;
  for_each_row(geometry, layout, page, [&](std::int64_t, std::int64_t length, std::int64_t index) {
    const float* row = values.data() + index;
    inside = inside && std::all_of(row, row + length, [limit](float phi) { return phi == limit; });
    outside = outside && std::all_of(row, row + length, [limit](float phi) { return phi == -limit; });
  });
  if (inside || outside) return pages.set_constant(page, inside ? Kind::inside : Kind::outside);
  std::copy(values.begin(), values.end(), pages.store(page));
}

void Field::update_page(std::int64_t page, const float* values) {
  const auto bytes = static_cast<std::size_t>(layout.voxels_per_page()) * sizeof(float);
  const float* const there = pages.values(page);
  if (there == nullptr || std::memcmp(there, values, bytes) != 0)
    std::memcpy(pages.store(page), values, bytes);
}

bool same_pages(const Field& a, const Field& b) {
  if (!(a.layout == b.layout)) return false;
  bool same = true;
  const auto bytes = static_cast<std::size_t>(a.layout.voxels_per_page()) * sizeof(float);
  SharedPages::for_each_difference(a.pages, b.pages, [&](std::int64_t page) {
    same = same && a.pages.is_stored(page) && b.pages.is_stored(page) &&
           std::memcmp(a.pages.values(page), b.pages.values(page), bytes) == 0;
  });
  return same;
}

}  // namespace tidemark::solver
