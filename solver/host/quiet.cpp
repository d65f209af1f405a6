// Quiet pages: where nothing moves, nothing is computed.
//
// A page is still when phi changed by at most kQuietChange in it over a window of steps, judged
// beside the surface. It sleeps when it and the 18 pages around it (faces and edges, as far as the stencil
// reaches) are still, and wakes as soon as one of them moves. A threshold on single steps would freeze slow
// fronts.
#include <algorithm>

#include "solver/host/host_executor.h"
#include "solver/host/page_code.h"

namespace tidemark {
namespace {

// Whether a neighbour (of 27) shares a face or an edge, or is the page itself.
constexpr bool within_stencil(int neighbour) {
  const int x = neighbour % 3 - 1;
  const int y = neighbour / 3 % 3 - 1;
  const int z = neighbour / 9 - 1;
  return x * x + y * y + z * z <= 2;
}

}  // namespace

void HostExecutor::wake(PhysicalPage page) {
  PageInfo& info = pool_.info(page);
  if (!info.asleep) return;
  info.asleep = false;
  --quiet_pages_;
  info.near_voxels = 0;
  active_list_is_stale_ = true;
}

void HostExecutor::wake_around(PhysicalPage page) {
  pool_.info(page).woke_neighbours = true;
  if (quiet_pages_ == 0) return;
  for (int n = 0; n < 27; ++n) {
    const PhysicalPage other = pool_.info(page).neighbours[n];
    if (other >= kFirstPage && within_stencil(n)) wake(other);
  }
}

void HostExecutor::wake_all() {
  for_each_resident([&](PhysicalPage page) { wake(page); });
}

void HostExecutor::put_to_sleep(PhysicalPage page) {
  PageInfo& info = pool_.info(page);
  info.asleep = true;
  ++quiet_pages_;
  // Its voxels belong to the surface, and they do not move.
  info.near_voxels /= kMotionSamples;
  std::copy_n(pool_.phi(current_, page), kPageVoxels, pool_.phi(1 - current_, page));
  pool_.masks(1 - current_, page) = pool_.masks(current_, page);
}

// At the end of a window: puts pages to sleep.
void HostExecutor::judge_quiet_pages() {
  const auto still = [&](PhysicalPage page) {
    return page < kFirstPage || pool_.info(page).asleep || pool_.info(page).change <= kQuietChange;
  };
  std::vector<PhysicalPage> quiet;
  if (options_.skip_quiet_pages) {
    for (const PhysicalPage page : active_) {
      if (table_.virtual_page(page) < 0) continue;  // freed in this step
      const PageInfo& info = pool_.info(page);
      bool all_still = still(page);  // first, because it most often decides
      for (int n = 0; n < 27 && all_still; ++n) all_still = !within_stencil(n) || still(info.neighbours[n]);
      if (all_still) quiet.push_back(page);
    }
  }
  for (const PhysicalPage page : quiet) put_to_sleep(page);
  if (!quiet.empty()) active_list_is_stale_ = true;
}

Result<std::vector<std::int64_t>> HostExecutor::quiet_pages() const {
  std::vector<std::int64_t> pages;
  for_each_resident([&](PhysicalPage page) {
    if (pool_.info(page).asleep) pages.push_back(table_.virtual_page(page));
  });
  return pages;
}

// In time linear in the resident pages: only the new ones are sorted.
void HostExecutor::rebuild_active_list() {
  const auto first_new = listed_.begin() + listed_in_order_;
  if (first_new != listed_.end()) {
    std::sort(first_new, listed_.end());
    std::inplace_merge(listed_.begin(), first_new, listed_.end());
    // A page that was freed and made resident again is there twice.
    listed_.erase(std::unique(listed_.begin(), listed_.end()), listed_.end());
  }
  active_.clear();
  quiet_near_voxels_ = 0;
  std::erase_if(listed_, [&](std::int64_t virtual_page) {
    const PhysicalPage page = table_.physical(virtual_page);
    if (is_static_page(page)) return true;
    if (pool_.info(page).asleep) {
      quiet_near_voxels_ += pool_.info(page).near_voxels;
    } else {
      active_.push_back(page);
    }
    return false;
  });
  listed_in_order_ = std::ssize(listed_);
  codes_.resize(active_.size());
  active_list_is_stale_ = false;
}

}  // namespace tidemark
