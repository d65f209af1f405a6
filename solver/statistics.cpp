#include "solver/statistics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <vector>

#include "core/index_walk.h"
#include "core/thread_pool.h"
#include "solver/page_with_apron.h"
#include "solver/paging/page_neighbours.h"

namespace tidemark::solver {
namespace {

// How much phi changes over a voxel, summed over the axes: |grad phi| times the voxel's extent along the
// normal. By central differences; one-sided at the volume's border.
double change_over_voxel(const PageWithApron& phi, Index3 local, Index3 voxel, Index3 size) {
  double change = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    Index3 unit(0);
    unit[axis] = 1;
    const bool at_border = voxel[axis] == 0 || voxel[axis] + 1 == size[axis];
    change += std::abs(phi.at(local + unit) - phi.at(local - unit)) * (at_border ? 1.0 : 0.5);
  }
  return change;
}

// The area of the triangle or quadrilateral in which phi = 0, interpolated linearly, cuts a tetrahedron.
double area_in_tetrahedron(const std::array<glm::dvec3, 4>& corners, const std::array<double, 4>& phi) {
  std::array<std::size_t, 4> order{};  // corners inside first
  std::size_t inside = 0;
  std::size_t last = 4;
  for (std::size_t i = 0; i < 4; ++i) order[phi[i] > 0.0 ? inside++ : --last] = i;
  const auto crossing = [&](std::size_t a, std::size_t b) {
    const std::size_t i = order[a];
    const std::size_t j = order[b];
    return glm::mix(corners[i], corners[j], phi[i] / (phi[i] - phi[j]));
  };
  const auto triangle = [](glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) {
    return 0.5 * glm::length(glm::cross(b - a, c - a));
  };
  if (inside == 1) return triangle(crossing(0, 1), crossing(0, 2), crossing(0, 3));
  if (inside == 3) return triangle(crossing(0, 3), crossing(1, 3), crossing(2, 3));
  if (inside != 2) return 0.0;
  const glm::dvec3 a = crossing(0, 2);
  const glm::dvec3 b = crossing(0, 3);
  const glm::dvec3 c = crossing(1, 3);
  const glm::dvec3 d = crossing(1, 2);
  return triangle(a, b, c) + triangle(a, c, d);
}

// A cell is divided into the six tetrahedra around its diagonal from corner 0 to corner 7.
double area_in_cell(const Cell& phi, glm::dvec3 spacing) {
  int inside = 0;
  for (const float value : phi) inside += value > 0.0F ? 1 : 0;
  if (inside == 0 || inside == 8) return 0.0;
  constexpr std::size_t kPaths[6][2] = {{1, 3}, {3, 2}, {2, 6}, {6, 4}, {4, 5}, {5, 1}};
  const auto corner = [&](std::size_t i) { return glm::dvec3(i & 1U, i >> 1U & 1U, i >> 2U) * spacing; };
  double area = 0.0;
  for (const auto& [a, b] : kPaths) {
    area +=
        area_in_tetrahedron({corner(0), corner(a), corner(b), corner(7)}, {phi[0], phi[a], phi[b], phi[7]});
  }
  return area;
}

// The share of a voxel that is inside: the surface is taken as a plane at distance phi / |grad phi|, and the
// share as linear in that distance over the voxel's extent along the normal.
double share_inside(double value, double change) {
  if (change == 0.0) return value > 0.0 ? 1.0 : 0.0;
  return std::clamp(0.5 + value / change, 0.0, 1.0);
}

}  // namespace

SurfaceMeter::PageSums SurfaceMeter::sums_of(const Field& phi, std::int64_t page, PageWithApron& values) {
  PageSums sums;
  const Geometry& geometry = phi.geometry;
  const Index3 first = phi.layout.first_voxel(page);
  values.gather(page);
  for_each_index(Index3(0), phi.layout.valid_shape(page), [&](Index3 local) {
    const Index3 voxel = first + local;
    const double value = values.at(local);
    if (value > 0.0) ++sums.voxels_inside;
    if (std::abs(value) < phi.band) {
      sums.voxels += share_inside(value, change_over_voxel(values, local, voxel, geometry.size));
    } else if (value > 0.0) {
      sums.voxels += 1.0;
    }
    // A single slice, along any axis, goes on as it is for its thickness: its surface is its outline times
    // that.
    const Index3 next = voxel + Index3(glm::notEqual(geometry.size, Index3(1)));
    if (geometry.contains(next)) sums.surface_mm2 += area_in_cell(values.cell(local), geometry.spacing_mm);
  });
  return sums;
}

void SurfaceMeter::begin(const Field& phi) {
  measured_ = Field::empty(phi.geometry, phi.band, phi.layout.page_shape());
  sums_.clear();
  constant_inside_ = 0;
}

// Measures the pages that have changed, and those beside them, whose differences and cells reach into them.
void SurfaceMeter::follow(const Field& phi) {
  const PageLayout& layout = phi.layout;
  const bool had_pages = !sums_.empty();
  std::vector<std::int64_t> pages;
  const auto inside = [&](const SharedPages& all, std::int64_t page) {
    const Index3 valid = layout.valid_shape(page);
    return all.kind(page) == Field::Kind::inside ? valid.x * valid.y * valid.z : 0;
  };
  SharedPages::for_each_difference(measured_->pages, phi.pages, [&](std::int64_t page) {
    constant_inside_ += inside(phi.pages, page) - inside(measured_->pages, page);
    if (!phi.pages.is_stored(page)) sums_.erase(page);
    if (!had_pages) return;
    for (int n = 0; n < kNeighbours; ++n) {
      const Index3 at = layout.page_coordinates(page) + neighbour_step(n);
      if (!layout.contains_page(at)) continue;
      if (const std::int64_t beside = layout.page_number(at); phi.pages.is_stored(beside))
        pages.push_back(beside);
    }
  });
  if (had_pages) {
    std::sort(pages.begin(), pages.end());
    pages.erase(std::unique(pages.begin(), pages.end()), pages.end());
  } else {
    pages = phi.pages.stored_pages();
  }
  add(phi, pages);
  measured_ = phi;
}

void SurfaceMeter::add(const Field& phi, const std::vector<std::int64_t>& pages) {
  constexpr std::int64_t kWorthThreads = 256;  // pages: a millisecond
  ThreadPool pool(std::ssize(pages) < kWorthThreads ? 1 : threads_);
  std::vector<PageWithApron> values(static_cast<std::size_t>(pool.threads()), PageWithApron(phi));
  std::vector<PageSums> sums(pages.size());
  pool.for_each(std::ssize(pages), 16, [&](std::int64_t begin, std::int64_t end, int member) {
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i)
      sums[i] = sums_of(phi, pages[i], values[static_cast<std::size_t>(member)]);
  });
  for (std::size_t i = 0; i < pages.size(); ++i) sums_[pages[i]] = sums[i];
}

SurfaceStatistics SurfaceMeter::measure(const Field& phi) {
  const bool follows = measured_ && measured_->layout == phi.layout && measured_->band == phi.band &&
                       measured_->geometry.spacing_mm == phi.geometry.spacing_mm;
  if (!follows) begin(phi);
  follow(phi);
  SurfaceStatistics result{constant_inside_, 0.0, 0.0};
  auto voxels = static_cast<double>(constant_inside_);
  for (const auto& [page, sums] : sums_) {
    result.voxels_inside += sums.voxels_inside;
    voxels += sums.voxels;
    result.surface_mm2 += sums.surface_mm2;
  }
  result.volume_ml = voxels * phi.geometry.voxel_volume_ml();
  return result;
}

SurfaceStatistics measure(const Field& phi) {
  return SurfaceMeter().measure(phi);
}

}  // namespace tidemark::solver
