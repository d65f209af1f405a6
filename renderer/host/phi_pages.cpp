#include "renderer/host/phi_pages.h"

#include <algorithm>
#include <bit>
#include <glm/common.hpp>

namespace tidemark::renderer {

PhiPages::PhiPages(const solver::PageLayout& layout, double band)
    : layout_(layout), size_(layout.domain_size()), pages_(layout.pages()) {
  for (int axis = 0; axis < 3; ++axis) {
    shift_[axis] = std::countr_zero(static_cast<std::uint64_t>(layout.page_shape()[axis]));
  }
  mask_ = glm::ivec3(layout.page_shape()) - 1;
  values_.resize(static_cast<std::size_t>(layout.page_count()));
  states_.resize(values_.size());
  was_resident_.resize(values_.size());
  begin(band);
  std::fill(values_.begin(), values_.end(), outside_.data());
}

void PhiPages::begin(double band) {
  ++revision_;
  const float limit = static_cast<float>(band);
  if (limit == band_) return;
  band_ = limit;
  outside_.assign(static_cast<std::size_t>(layout_.voxels_per_page()), -limit);
  inside_.assign(outside_.size(), limit);
}

void PhiPages::mark(std::span<const std::int64_t> quiet) {
  std::vector<bool> resident(values_.size());
  std::int64_t residents = 0;
  std::int64_t new_pages = 0;
  for (std::size_t page = 0; page < values_.size(); ++page) {
    resident[page] = !is_static(values_[page]);
    residents += resident[page] ? 1 : 0;
    new_pages += resident[page] && !was_resident_[page] ? 1 : 0;
    const bool inside = values_[page] == inside_.data();
    states_[page] = resident[page] ? PageState::resident : inside ? PageState::inside : PageState::outside;
  }
  for (const std::int64_t page : quiet) states_[static_cast<std::size_t>(page)] = PageState::quiet;
  if (new_pages < residents) {
    for (std::size_t page = 0; page < values_.size(); ++page) {
      if (resident[page] && !was_resident_[page]) states_[page] = PageState::new_page;
    }
  }
  was_resident_ = std::move(resident);
}

void PhiPages::show(std::shared_ptr<const solver::Field> phi, std::span<const std::int64_t> quiet) {
  begin(phi->band);
  for (std::size_t page = 0; page < values_.size(); ++page) {
    const auto number = static_cast<std::int64_t>(page);
    const float* const stored = phi->pages.values(number);
    const bool is_inside = phi->pages.kind(number) == solver::Field::Kind::inside;
    values_[page] = stored != nullptr ? stored : is_inside ? inside_.data() : outside_.data();
  }
  copy_ = std::move(phi);
  mark(quiet);
}

void PhiPages::show(const solver::PageView& view, const std::optional<std::vector<std::int64_t>>& quiet) {
  begin(view.band);
  const std::vector<solver::PhysicalPage>& entries = view.memory->table().entries();
  for (std::size_t page = 0; page < values_.size(); ++page) {
    const solver::PhysicalPage entry = entries[page];
    values_[page] = entry == solver::kOutsidePage  ? outside_.data()
                    : entry == solver::kInsidePage ? inside_.data()
                                                   : view.phi(entry);
  }
  copy_.reset();
  if (quiet) mark(*quiet);
}

std::vector<std::int64_t> PhiPages::resident_pages() const {
  std::vector<std::int64_t> pages;
  for (std::size_t page = 0; page < values_.size(); ++page) {
    if (!is_static(values_[page])) pages.push_back(static_cast<std::int64_t>(page));
  }
  return pages;
}

float PhiPages::at(glm::ivec3 voxel) const {
  const glm::ivec3 v = glm::clamp(voxel, glm::ivec3(0), size_ - 1);
  return values_of(page_number(page_of(v)))[offset_in_page(v)];
}

float PhiPages::between(glm::vec3 position) const {
  const glm::vec3 p = glm::clamp(position, glm::vec3(0.0F), glm::vec3(size_ - 1));
  const glm::ivec3 low = glm::min(glm::ivec3(p), glm::max(size_ - 2, glm::ivec3(0)));
  const glm::vec3 f = p - glm::vec3(low);
  float corner[8];
  const glm::ivec3 local = low & mask_;
  if (local.x < mask_.x && local.y < mask_.y && local.z < mask_.z) {
    // All eight in one page, as most are.
    const float* page = values_of(page_number(page_of(low)));
    if (is_static(page)) return *page;
    const float* first = page + offset_in_page(low);
    const int y = 1 << shift_.x;
    const int z = y << shift_.y;
    for (int i = 0; i < 8; ++i) corner[i] = first[(i & 1) + (i & 2 ? y : 0) + (i & 4 ? z : 0)];
  } else {
    const glm::ivec3 high = glm::min(low + 1, size_ - 1);
    const int pages[3][2] = {
        {low.x >> shift_.x, high.x >> shift_.x},
        {(low.y >> shift_.y) * pages_.x, (high.y >> shift_.y) * pages_.x},
        {(low.z >> shift_.z) * pages_.x * pages_.y, (high.z >> shift_.z) * pages_.x * pages_.y}};
    const int offsets[3][2] = {
        {local.x, high.x & mask_.x},
        {local.y << shift_.x, (high.y & mask_.y) << shift_.x},
        {local.z << (shift_.x + shift_.y), (high.z & mask_.z) << (shift_.x + shift_.y)}};
    for (int i = 0; i < 8; ++i) {
      const int x = i & 1;
      const int y = i >> 1 & 1;
      const int z = i >> 2;
      corner[i] =
          values_of(pages[0][x] + pages[1][y] + pages[2][z])[offsets[0][x] + offsets[1][y] + offsets[2][z]];
    }
  }
  float along_z[4];
  for (int i = 0; i < 4; ++i) along_z[i] = glm::mix(corner[i], corner[i + 4], f.z);
  return glm::mix(glm::mix(along_z[0], along_z[2], f.y), glm::mix(along_z[1], along_z[3], f.y), f.x);
}

glm::vec3 PhiPages::slope(glm::vec3 p) const {
  glm::vec3 slope;
  for (int axis = 0; axis < 3; ++axis) {
    glm::vec3 h(0.0F);
    h[axis] = 1.0F;
    slope[axis] = 0.5F * (between(p + h) - between(p - h));
  }
  return slope;
}

}  // namespace tidemark::renderer
