#include "solver/host/quiet_pages.h"

#include <algorithm>

#include "solver/paging/page_neighbours.h"

namespace tidemark::solver {
namespace {

// Whether a neighbour shares a face or an edge, or is the page itself.
constexpr bool within_stencil(int neighbour) {
  const Index3 step = neighbour_step(neighbour);
  return step.x * step.x + step.y * step.y + step.z * step.z <= 2;
}

}  // namespace

void QuietPages::clear() {
  active_.clear();
  count_ = 0;
  states_changed_ = true;
}

void QuietPages::wake(PhysicalPage page) {
  PageInfo& info = pages_.pool().info(page);
  if (!info.asleep) return;
  info.asleep = false;
  --count_;
  info.near_voxels = 0;
  states_changed_ = true;
}

void QuietPages::wake_around(PhysicalPage page) {
  PageInfo& info = pages_.pool().info(page);
  info.woke_neighbours = true;
  if (count_ == 0) return;
  for (int n = 0; n < kNeighbours; ++n) {
    if (info.neighbours[n] >= kFirstPage && within_stencil(n)) wake(info.neighbours[n]);
  }
}

void QuietPages::wake_all() {
  pages_.for_each([&](PhysicalPage page) { wake(page); });
}

void QuietPages::put_to_sleep(PhysicalPage page) {
  PagePool& pool = pages_.pool();
  PageInfo& info = pool.info(page);
  info.asleep = true;
  ++count_;
  // Its voxels belong to the surface, and they do not move.
  info.near_voxels /= kMotionSamples;
  const int next = 1 - pages_.current();
  std::copy_n(pages_.phi(page), kPageVoxels, pool.phi(next, page));
  pool.masks(next, page) = pool.masks(pages_.current(), page);
  states_changed_ = true;
}

bool QuietPages::is_still(PhysicalPage page) const {
  if (page < kFirstPage) return true;
  const PageInfo& info = pages_.pool().info(page);
  return info.asleep || info.change <= kQuietChange;
}

bool QuietPages::surroundings_are_still(PhysicalPage page) const {
  const PageInfo& info = pages_.pool().info(page);
  for (int n = 0; n < kNeighbours; ++n) {
    if (within_stencil(n) && !is_still(info.neighbours[n])) return false;
  }
  return true;
}

SurfaceMotion QuietPages::motion() const {
  SurfaceMotion motion;
  motion.add_resting(near_voxels_ * kMotionSamples);
  for (const PhysicalPage page : active_) {
    const PageInfo& info = pages_.pool().info(page);
    motion.add_page(static_cast<double>(info.squared_change), info.near_voxels);
  }
  return motion;
}

void QuietPages::judge() {
  if (!skip_) return;
  std::vector<PhysicalPage> quiet;
  for (const PhysicalPage page : active_) {
    if (pages_.table().virtual_page(page) < 0) continue;  // freed in this step
    // Itself first, because it most often decides.
    if (is_still(page) && surroundings_are_still(page)) quiet.push_back(page);
  }
  for (const PhysicalPage page : quiet) put_to_sleep(page);
}

void QuietPages::begin_window() {
  for (const PhysicalPage page : active_) {
    PageInfo& info = pages_.pool().info(page);
    if (!info.asleep) info.near_voxels = 0;
    info.change = 0.0F;
    info.squared_change = 0.0F;
    info.woke_neighbours = false;
  }
}

// In time linear in the resident pages.
void QuietPages::refresh_active() {
  if (!active_list_is_stale()) return;
  active_.clear();
  near_voxels_ = 0;
  pages_.for_each_in_order([&](PhysicalPage page) {
    const PageInfo& info = pages_.pool().info(page);
    if (info.asleep) {
      near_voxels_ += info.near_voxels;
    } else {
      active_.push_back(page);
    }
  });
  states_changed_ = false;
  seen_changes_ = pages_.table().changes();
}

std::vector<std::int64_t> QuietPages::virtual_pages() const {
  std::vector<std::int64_t> pages;
  pages_.for_each([&](PhysicalPage page) {
    if (pages_.pool().info(page).asleep) pages.push_back(pages_.table().virtual_page(page));
  });
  return pages;
}

std::int64_t QuietPages::state_bytes() const {
  return static_cast<std::int64_t>(active_.capacity() * sizeof(PhysicalPage));
}

Status QuietPages::validate() const {
  const PageTable& table = pages_.table();
  const PagePool& pool = pages_.pool();
  Status result;
  std::int64_t asleep = 0;
  pages_.for_each([&](PhysicalPage page) {
    if (!pool.info(page).asleep) return;
    ++asleep;
    if (std::equal(pool.phi(0, page), pool.phi(0, page) + kPageVoxels, pool.phi(1, page))) return;
    result = fail(ErrorKind::internal, "page {} is quiet, but its two buffers differ", page);
  });
  if (!result) return result;
  if (asleep != count_) {
    return fail(ErrorKind::internal, "{} pages are quiet, and {} are counted", asleep, count_);
  }
  if (active_list_is_stale()) return {};
  if (std::ssize(active_) != table.resident() - asleep) {
    return fail(ErrorKind::internal, "{} pages are active, and {} are listed", table.resident() - asleep,
                active_.size());
  }
  std::int64_t before = -1;
  for (const PhysicalPage page : active_) {
    if (table.virtual_page(page) <= before || pool.info(page).asleep) {
      return fail(ErrorKind::internal, "page {} is not in its place in the list of active pages", page);
    }
    before = table.virtual_page(page);
  }
  return {};
}

}  // namespace tidemark::solver
