// Replacing and painting phi in the host executor.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>

#include "solver/host/host_executor.h"

namespace tidemark {

Status HostExecutor::restore(const Field& phi) {
  TIDEMARK_TRY(phi.check_fits(source_->geometry, band()));
  if (phi.layout.page_shape() != kDefaultPageShape) {
    return restore(Field::from_dense(phi.geometry, phi.dense(), phi.band));
  }
  TIDEMARK_TRY(check_budget(phi.resident_pages() - table_.resident()));

  clear();
  for (std::int64_t page = 0; page < phi.layout.page_count(); ++page) {
    if (phi.table[static_cast<std::size_t>(page)] == Field::kInside) table_.set_static(page, true);
  }
  for (std::int64_t page = 0; page < phi.layout.page_count(); ++page) {
    if (phi.table[static_cast<std::size_t>(page)] < 0) continue;
    TIDEMARK_TRY(make_resident(page));
  }
  fill_new_pages();
  for_each_resident([&](PhysicalPage page) {
    const std::int32_t entry = phi.table[static_cast<std::size_t>(table_.virtual_page(page))];
    std::copy_n(phi.pages.data() + std::int64_t{entry} * kPageVoxels, kPageVoxels, pool_.phi(current_, page));
    refresh_masks(page);
  });
  return activate_all();
}

Result<Field> HostExecutor::snapshot() const {
  Field field = Field::empty(source_->geometry, model_.band());
  field.pages.reserve(static_cast<std::size_t>(table_.resident() * kPageVoxels));
  for (std::int64_t page = 0; page < table_.layout().page_count(); ++page) {
    const PhysicalPage physical = table_.physical(page);
    std::int32_t& entry = field.table[static_cast<std::size_t>(page)];
    if (physical == kInsidePage) {
      entry = Field::kInside;
    } else if (physical != kOutsidePage) {
      entry = static_cast<std::int32_t>(field.resident_pages());
      const float* phi = pool_.phi(current_, physical);
      field.pages.insert(field.pages.end(), phi, phi + kPageVoxels);
    }
  }
  return field;
}

Status HostExecutor::paint(const Sphere& sphere, Brush brush) {
  const Geometry& geometry = source_->geometry;
  const PageLayout& layout = table_.layout();
  const glm::dvec3 centre = geometry.to_voxel(sphere.centre_mm);
  const glm::dvec3 reach =
      (sphere.radius_mm + model_.band() * model_.smallest_spacing_mm()) / geometry.spacing_mm;
  const glm::dvec3 last_voxel(geometry.size - Index3(1));
  const Index3 first_page =
      Index3(glm::clamp(glm::floor(centre - reach), glm::dvec3(0), last_voxel)) / layout.page_shape();
  const Index3 last_page =
      Index3(glm::clamp(glm::ceil(centre + reach), glm::dvec3(0), last_voxel)) / layout.page_shape();

  using Values = std::array<float, kPageVoxels>;
  std::vector<std::int64_t> to_allocate;
  std::vector<Index3> to_flip;  // pages that are not resident and change from all outside to inside or back
  const auto painted = [&](Index3 coordinates, const float* phi, Values& values) {
    const Index3 first = coordinates * layout.page_shape();
    for (int i = 0; i < kPageVoxels; ++i) {
      const glm::dvec3 voxel(first + Index3(i % kPageSide, i / kPageSide % kPageSide, i / kPageRows));
      const glm::dvec3 offset = (voxel - centre) * geometry.spacing_mm;
      const double distance =
          sphere.radius_mm - std::sqrt(offset.x * offset.x + offset.y * offset.y + offset.z * offset.z);
      const float d = std::clamp(static_cast<float>(distance / model_.smallest_spacing_mm()),
                                 -constants_.band, constants_.band);
      values[static_cast<std::size_t>(i)] = brush == Brush::add ? std::max(phi[i], d) : std::min(phi[i], -d);
    }
  };
  const auto for_each_page = [&](const auto& visit) {
    for (std::int64_t z = first_page.z; z <= last_page.z; ++z) {
      for (std::int64_t y = first_page.y; y <= last_page.y; ++y) {
        for (std::int64_t x = first_page.x; x <= last_page.x; ++x) {
          const Index3 coordinates(x, y, z);
          const PhysicalPage page = table_.physical(coordinates);
          visit(coordinates, page, pool_.phi(current_, page));
        }
      }
    }
  };

  Values values;
  for_each_page([&](Index3 coordinates, PhysicalPage page, const float* phi) {
    if (!is_static_page(page)) return;
    painted(coordinates, phi, values);
    const float constant = phi[0];
    if (std::all_of(values.begin(), values.end(), [&](float v) { return v == constant; })) return;
    if (std::all_of(values.begin(), values.end(), [&](float v) { return v == -constant; })) {
      to_flip.push_back(coordinates);
    } else {
      to_allocate.push_back(layout.page_number(coordinates));
    }
  });
  TIDEMARK_TRY(check_budget(static_cast<std::int64_t>(to_allocate.size())));

  for (const Index3 coordinates : to_flip) {
    const bool inside = brush == Brush::add;
    table_.set_static(layout.page_number(coordinates), inside);
    tell_neighbours(coordinates, inside ? kInsidePage : kOutsidePage);
  }
  for (const std::int64_t virtual_page : to_allocate) {
    TIDEMARK_TRY(make_resident(virtual_page));
  }
  fill_new_pages();
  for_each_page([&](Index3 coordinates, PhysicalPage page, float* phi) {
    if (is_static_page(page)) return;
    painted(coordinates, phi, values);
    if (std::equal(values.begin(), values.end(), phi)) return;
    std::copy(values.begin(), values.end(), phi);
    refresh_masks(page);
    wake_around(page);
  });
  begin_window();
  return activate_all();
}

}  // namespace tidemark
