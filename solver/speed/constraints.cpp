#include "solver/speed/constraints.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include "core/index_walk.h"

namespace tidemark::solver {

namespace {

Constraint limit(int first, double steps) {
  constexpr double kMost = 2.0 * static_cast<double>(kLimitReach) * kLimitSteps;
  return static_cast<Constraint>(first + static_cast<int>(std::clamp(steps, 0.0, kMost)));
}

double steps_from_lowest(double phi) {
  return (phi + static_cast<double>(kLimitReach)) * kLimitSteps;
}

// allows_constant() of one page after the other. Most pages of a motion limit are one page in memory, which
// is then looked at once.
class AllowedConstants {
 public:
  bool allows(const Constraint* page, bool inside) {
    Answer& last = last_[inside ? 1 : 0];
    if (page != last.page) last = {page, allows_constant(page, inside)};
    return last.allowed;
  }

 private:
  struct Answer {
    const Constraint* page = nullptr;
    bool allowed = true;
  };
  Answer last_[2];
};

}  // namespace

Constraint at_most(double phi) {
  if (phi >= static_cast<double>(kLimitReach)) return Constraint::none;
  return limit(kFirstAtMost, std::floor(steps_from_lowest(phi)));
}

Constraint at_least(double phi) {
  if (phi <= -static_cast<double>(kLimitReach)) return Constraint::none;
  return limit(kFirstAtLeast, std::ceil(steps_from_lowest(phi)));
}

bool allows_constant(const Constraint* page, bool inside) {
  return std::none_of(page, page + Constraints::kPageVoxels, inside ? is_upper : is_lower);
}

Constraints::Constraints(Index3 grid_size)
    : layout_(grid_size, kDefaultPageShape), pages_(layout_.page_count(), kPageVoxels) {}

Constraint Constraints::at(Index3 voxel) const {
  const VirtualAddress address = layout_.translate(voxel);
  const Constraint* const there = page(address.page);
  return there == nullptr ? Constraint::none : there[address.offset];
}

std::int64_t Constraints::count(Constraint what) const {
  std::int64_t sum = 0;
  for (const std::int64_t number : pages_.stored_pages()) {
    sum += std::count(page(number), page(number) + kPageVoxels, what);
  }
  return sum;
}

void Constraints::set_page(std::int64_t virtual_page, const Page& page) {
  if (std::all_of(page.begin(), page.end(), [](Constraint c) { return c == Constraint::none; })) {
    pages_.set_constant(virtual_page, Pages::Kind::outside);
  } else {
    std::copy(page.begin(), page.end(), pages_.store(virtual_page));
  }
}

Constraints::Page Constraints::copy_of(std::int64_t virtual_page) const {
  Page copy{};
  if (const Constraint* const there = page(virtual_page); there != nullptr)
    std::copy_n(there, kPageVoxels, copy.begin());
  return copy;
}

Constraints Constraints::over(const Constraints& other) const {
  Constraints joined = other;
  for (const std::int64_t number : pages_.stored_pages()) {
    const Constraint* const below = other.page(number);
    if (below == nullptr) {
      joined.pages_.share(number, pages_);
      continue;
    }
    Page page = copy_of(number);
    for (std::size_t i = 0; i < page.size(); ++i) {
      if (page[i] == Constraint::none) page[i] = below[i];
    }
    joined.set_page(number, page);
  }
  return joined;
}

void Constraints::set(const std::function<bool(Index3)>& chosen, Index3 first, Index3 last, Constraint what) {
  for_each_page(layout_, first, last + Index3(1), [&](Index3 page) {
    const std::int64_t number = layout_.page_number(page);
    Page values = copy_of(number);
    const Index3 start = layout_.first_voxel(number);
    bool changed = false;
    for_each_index(Index3(0), layout_.valid_shape(number), [&](Index3 local) {
      Constraint& value = values[static_cast<std::size_t>(number_in(layout_.page_shape(), local))];
      if (value == what || !chosen(start + local)) return;
      value = what;
      changed = true;
    });
    if (changed) set_page(number, values);
  });
}

void Constraints::set(const BitMask& mask, Constraint what) {
  set([&](Index3 voxel) { return mask.contains(mask.geometry().offset(voxel)); }, Index3(0),
      layout_.domain_size() - Index3(1), what);
}

void Constraints::set(const Geometry& geometry, const Sphere& sphere, Constraint what) {
  const glm::dvec3 centre = geometry.to_voxel(sphere.centre_mm);
  const glm::dvec3 reach = sphere.radius_mm / geometry.spacing_mm;
  const glm::dvec3 end(layout_.domain_size() - Index3(1));
  const glm::dvec3 low = glm::ceil(centre - reach);
  const glm::dvec3 high = glm::floor(centre + reach);
  if (glm::any(glm::lessThan(high, glm::dvec3(0.0))) || glm::any(glm::greaterThan(low, end))) return;
  const auto chosen = [&](Index3 voxel) {
    const glm::dvec3 offset = (glm::dvec3(voxel) - centre) * geometry.spacing_mm;
    return glm::dot(offset, offset) <= sphere.radius_mm * sphere.radius_mm;
  };
  set(chosen, Index3(glm::max(low, glm::dvec3(0.0))), Index3(glm::min(high, end)), what);
}

void Constraints::set(const std::vector<Index3>& voxels, Constraint what) {
  std::int64_t number = -1;  // of the page that is being changed: neighbours are mostly in one
  Page values{};
  for (const Index3& voxel : voxels) {
    const VirtualAddress address = layout_.translate(voxel);
    if (address.page != number) {
      if (number >= 0) set_page(number, values);
      number = address.page;
      values = copy_of(number);
    }
    values[static_cast<std::size_t>(address.offset)] = what;
  }
  if (number >= 0) set_page(number, values);
}

void constrain(Field& phi, const Constraints& constraints) {
  const PageLayout& layout = constraints.layout();
  const std::int64_t voxels = phi.layout.voxels_per_page();
  std::int64_t changed = -1;  // the page that was changed last
  float* values = nullptr;    // its own
  const auto limit = [&](Index3 voxel, Constraint what) {
    const VirtualAddress address = phi.layout.translate(voxel);
    if (address.page != changed) {
      const Field::Kind kind = phi.pages.kind(address.page);
      if (kind == (is_upper(what) ? Field::Kind::outside : Field::Kind::inside)) return;
      if (kind == Field::Kind::stored) {
        const float value = phi.pages.values(address.page)[address.offset];
        if (limited(what, value) == value) return;
        values = phi.pages.change(address.page);
      } else {
        const float constant = phi.constant(address.page);
        values = phi.pages.store(address.page);
        std::fill_n(values, voxels, constant);
      }
      changed = address.page;
    }
    values[address.offset] = limited(what, values[address.offset]);
  };
  AllowedConstants constants;
  for (const std::int64_t page : constraints.pages().stored_pages()) {
    const Constraint* const there = constraints.page(page);
    const Index3 first = layout.first_voxel(page);
    const bool stays = all_pages(phi.layout, first, first + layout.valid_shape(page), [&](Index3 other) {
      const Field::Kind kind = phi.pages.kind(phi.layout.page_number(other));
      return kind != Field::Kind::stored && constants.allows(there, kind == Field::Kind::inside);
    });
    if (stays) continue;
    for (std::int64_t i = 0; i < Constraints::kPageVoxels; ++i) {
      const Constraint what = there[i];
      if (what != Constraint::none) limit(first + Index3(i % 8, i / 8 % 8, i / 64), what);
    }
  }
}

bool Constraints::operator==(const Constraints& other) const {
  if (layout_ != other.layout_ || pages_.stored() != other.pages_.stored()) return false;
  bool same = true;
  Pages::for_each_difference(pages_, other.pages_, [&](std::int64_t number) {
    const Constraint* const a = page(number);
    const Constraint* const b = other.page(number);
    same = same && a != nullptr && b != nullptr && std::equal(a, a + kPageVoxels, b);
  });
  return same;
}

}  // namespace tidemark::solver
