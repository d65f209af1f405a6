#include "solver/host/page_edits.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>

#include "core/index_walk.h"
#include "solver/host/page_constraints.h"

namespace tidemark::solver {
namespace {

using Values = std::array<float, kPageVoxels>;

// A sphere on its way into phi.
struct Stroke {
  const Geometry& geometry;
  Sphere sphere;
  Brush brush;
  glm::dvec3 centre;  // voxels
  double unit_mm;     // the smallest spacing
  float band;

  // What phi becomes in a page.
  void paint(Index3 page, const float* phi, Values& values) const {
    const Index3 first = page * kDefaultPageShape;
    for (int i = 0; i < kPageVoxels; ++i) {
      const glm::dvec3 voxel(first + Index3(i % kPageSide, i / kPageSide % kPageSide, i / kPageRows));
      const glm::dvec3 offset = (voxel - centre) * geometry.spacing_mm;
      const double distance =
          sphere.radius_mm - std::sqrt(offset.x * offset.x + offset.y * offset.y + offset.z * offset.z);
      const float d = std::clamp(static_cast<float>(distance / unit_mm), -band, band);
      values[static_cast<std::size_t>(i)] = brush == Brush::add ? std::max(phi[i], d) : std::min(phi[i], -d);
    }
  }

  // Calls visit(coordinates) for each page that it may touch.
  template <class Visit>
  void for_each_page(Visit visit) const {
    const glm::dvec3 reach = (sphere.radius_mm + static_cast<double>(band) * unit_mm) / geometry.spacing_mm;
    const Index3 first = page_at(glm::floor(centre - reach));
    const Index3 last = page_at(glm::ceil(centre + reach));
    for_each_index(first, last + Index3(1), visit);
  }

 private:
  [[nodiscard]] Index3 page_at(glm::dvec3 voxel) const {
    return Index3(glm::clamp(voxel, glm::dvec3(0), glm::dvec3(geometry.size - Index3(1)))) /
           kDefaultPageShape;
  }
};

bool all_equal(const Values& values, float value) {
  return std::all_of(values.begin(), values.end(), [&](float v) { return v == value; });
}

}  // namespace

Status PageEdits::restore(const Field& phi) {
  TIDEMARK_TRY(phi.check_fits(contents_.geometry, contents_.model.band()));
  if (phi.layout.page_shape() != kDefaultPageShape) {
    return restore(phi.repaged(phi.band, kDefaultPageShape));
  }
  Field limited = phi;
  if (contents_.constraints != nullptr) tidemark::solver::constrain(limited, *contents_.constraints);
  const SharedPages& wanted = limited.pages;
  TIDEMARK_TRY(pages_.memory().check_budget(wanted.stored() - pages_.table().resident()));

  pages_.clear();
  quiet_.clear();
  for (std::int64_t page = 0; page < wanted.size(); ++page) {
    if (wanted.kind(page) != Field::Kind::inside) continue;
    pages_.set_static(limited.layout.page_coordinates(page), true);
  }
  for (const std::int64_t page : wanted.stored_pages()) {
    TIDEMARK_TRY(pages_.make_resident(page));
  }
  pages_.fill_new_pages();
  pages_.memory().for_each_resident([&](PhysicalPage page) {
    std::copy_n(wanted.values(pages_.memory().virtual_page(page)), kPageVoxels, pages_.phi(page));
    pages_.refresh(page);
  });
  pages_.know(wanted);
  static_cast<void>(pages_.activate_all());
  return {};
}

Status PageEdits::constrain() {
  if (const Constraints* constraints = contents_.constraints.get(); constraints != nullptr) {
    TIDEMARK_TRY(constrain(constraints->pages().stored_pages()));
  }
  static_cast<void>(pages_.activate_all());
  return {};
}

bool PageEdits::may_be_constant(std::int64_t virtual_page, bool inside) const {
  const Constraints* constraints = contents_.constraints.get();
  const Constraint* const there = constraints == nullptr ? nullptr : constraints->page(virtual_page);
  return there == nullptr || allows_constant(there, inside);
}

Status PageEdits::constrain(const std::vector<std::int64_t>& virtual_pages) {
  const Constraints* constraints = contents_.constraints.get();
  if (constraints == nullptr || constraints->empty()) return {};
  const PagedMemory<3>& memory = pages_.memory();
  std::vector<std::int64_t> to_allocate;
  for (const std::int64_t page : virtual_pages) {
    const PhysicalPage physical = memory.physical(page);
    // A page that is not resident is constant.
    if (!is_static_page(physical) || may_be_constant(page, physical == kInsidePage)) continue;
    to_allocate.push_back(page);
  }
  TIDEMARK_TRY(memory.check_budget(static_cast<std::int64_t>(to_allocate.size())));
  for (const std::int64_t page : to_allocate) {
    TIDEMARK_TRY(pages_.make_resident(page));
  }
  pages_.fill_new_pages();
  for (const std::int64_t virtual_page : virtual_pages) {
    const PhysicalPage page = memory.physical(virtual_page);
    const Constraint* const there = constraints->page(virtual_page);
    if (is_static_page(page) || there == nullptr) continue;
    if (!tidemark::solver::constrain(there, pages_.phi(page))) continue;
    pages_.refresh(page);
    quiet_.wake_around(page);
  }
  return {};
}

Status PageEdits::paint(const Sphere& sphere, Brush brush) {
  const Stroke stroke{contents_.geometry,
                      sphere,
                      brush,
                      contents_.geometry.to_voxel(sphere.centre_mm),
                      contents_.model.smallest_spacing_mm(),
                      static_cast<float>(contents_.model.band())};
  const PagedMemory<3>& memory = pages_.memory();
  std::vector<std::int64_t> below;  // the pages under the stroke
  std::vector<std::int64_t> to_allocate;
  std::vector<Index3> to_flip;  // pages that are not resident and change from all outside to inside or back
  Values values;
  stroke.for_each_page([&](Index3 coordinates) {
    below.push_back(memory.layout().page_number(coordinates));
    const PhysicalPage page = memory.physical(coordinates);
    if (!is_static_page(page)) return;
    stroke.paint(coordinates, pages_.phi(page), values);
    const float constant = *pages_.phi(page);
    if (all_equal(values, constant)) return;
    if (all_equal(values, -constant) && may_be_constant(below.back(), brush == Brush::add)) {
      to_flip.push_back(coordinates);
    } else {
      to_allocate.push_back(below.back());
    }
  });
  TIDEMARK_TRY(memory.check_budget(static_cast<std::int64_t>(to_allocate.size())));

  for (const Index3 coordinates : to_flip) pages_.set_static(coordinates, brush == Brush::add);
  for (const std::int64_t virtual_page : to_allocate) {
    TIDEMARK_TRY(pages_.make_resident(virtual_page));
  }
  pages_.fill_new_pages();
  stroke.for_each_page([&](Index3 coordinates) {
    const PhysicalPage page = memory.physical(coordinates);
    if (is_static_page(page)) return;
    float* phi = pages_.phi(page);
    stroke.paint(coordinates, phi, values);
    if (std::equal(values.begin(), values.end(), phi)) return;
    std::copy(values.begin(), values.end(), phi);
    pages_.refresh(page);
    quiet_.wake_around(page);
  });
  TIDEMARK_TRY(constrain(below));
  static_cast<void>(pages_.activate_around(below));
  return {};
}

}  // namespace tidemark::solver
