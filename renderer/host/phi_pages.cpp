#include "renderer/host/phi_pages.h"

#include <algorithm>
#include <bit>
#include <glm/common.hpp>
#include <utility>

namespace tidemark::renderer {
namespace {

// Two rows of two voxels.
using Rows = float __attribute__((vector_size(4 * sizeof(float))));

}  // namespace

PhiPages::PhiPages(const PageLayout& layout, double band)
    : layout_(layout), size_(layout.domain_size()), pages_(layout.pages()) {
  for (int axis = 0; axis < 3; ++axis) {
    shift_[axis] = std::countr_zero(static_cast<std::uint64_t>(layout.page_shape()[axis]));
  }
  mask_ = glm::ivec3(layout.page_shape()) - 1;
  values_.resize(static_cast<std::size_t>(layout.page_count()));
  states_.resize(values_.size());
  was_resident_.resize(values_.size());
  changed_.resize(values_.size());
  begin(band);
  std::fill(values_.begin(), values_.end(), outside_.data());
}

void PhiPages::begin(double band) {
  ++revision_;
  const float limit = static_cast<float>(band);
  if (limit == band_) return;
  band_ = limit;
  memory_ = nullptr;
  copy_.reset();
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
  // Two copies have what is the same at the same place, as long as both are there.
  const bool comparable = copy_ != nullptr;
  for (std::size_t page = 0; page < values_.size(); ++page) {
    const auto number = static_cast<std::int64_t>(page);
    const float* const stored = phi->pages.values(number);
    const bool is_inside = phi->pages.kind(number) == solver::Field::Kind::inside;
    const float* const former = values_[page];
    values_[page] = stored != nullptr ? stored : is_inside ? inside_.data() : outside_.data();
    if (!comparable || values_[page] != former) changed_[page] = revision_;
  }
  copy_ = std::move(phi);
  memory_ = nullptr;
  mark(quiet);
}

void PhiPages::show(const solver::PageView& view, const std::optional<std::vector<std::int64_t>>& quiet) {
  begin(view.band);
  const std::vector<solver::PhysicalPage>& entries = view.memory->table().entries();
  // One that lies where another did is told by its moments, which are later.
  const bool is_another = std::exchange(memory_, view.memory) != view.memory;
  for (std::size_t page = 0; page < values_.size(); ++page) {
    const solver::PhysicalPage entry = entries[page];
    values_[page] = entry == solver::kOutsidePage  ? outside_.data()
                    : entry == solver::kInsidePage ? inside_.data()
                                                   : view.phi(entry);
    const auto number = static_cast<std::int64_t>(page);
    if (is_another || view.memory->has_changed_since(number, seen_)) changed_[page] = revision_;
  }
  seen_ = view.memory->end_moment();
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

// The four rows of two voxels around the position, in lanes.
float PhiPages::between(glm::vec3 position) const {
  const glm::vec3 p = glm::clamp(position, glm::vec3(0.0F), glm::vec3(size_ - 1));
  const glm::ivec3 low = glm::min(glm::ivec3(p), glm::max(size_ - 2, glm::ivec3(0)));
  const glm::vec3 f = p - glm::vec3(low);
  const glm::ivec3 local = low & mask_;
  const int page = page_number(page_of(low));
  // Whether the second voxel along an axis is in the next page; the volume's end has none.
  const glm::ivec3 high = glm::min(low + 1, size_ - 1);
  const bool leaves_x = (high.x >> shift_.x) != (low.x >> shift_.x);
  const int page_y = (high.y >> shift_.y) != (low.y >> shift_.y) ? pages_.x : 0;
  const int page_z = (high.z >> shift_.z) != (low.z >> shift_.z) ? pages_.x * pages_.y : 0;
  const float* const first = values_of(page);
  if (!leaves_x && page_y == 0 && page_z == 0 && is_static(first)) return *first;
  const int y[2] = {local.y << shift_.x, (high.y & mask_.y) << shift_.x};
  const int z[2] = {local.z << (shift_.x + shift_.y), (high.z & mask_.z) << (shift_.x + shift_.y)};
  const auto rows = [&](int page_z_beside, int offset_z) {
    const float* const near = values_of(page + page_z_beside) + y[0] + offset_z;
    const float* const far = values_of(page + page_z_beside + page_y) + y[1] + offset_z;
    const float* const near_end =
        leaves_x ? values_of(page + page_z_beside + 1) + y[0] + offset_z : near + local.x + 1;
    const float* const far_end =
        leaves_x ? values_of(page + page_z_beside + page_y + 1) + y[1] + offset_z : far + local.x + 1;
    return Rows{near[local.x], *near_end, far[local.x], *far_end};
  };
  const Rows along_z = rows(0, z[0]) * (1.0F - f.z) + rows(page_z, z[1]) * f.z;
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
