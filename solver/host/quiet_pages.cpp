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
  computed_ = false;
  count_ = 0;
  states_changed_ = true;
}

void QuietPages::wake(PhysicalPage page) {
  PageInfo& info = pages_.fields().info(page);
  if (!info.asleep) return;
  info.asleep = false;
  --count_;
  states_changed_ = true;
}

void QuietPages::wake_around(PhysicalPage page) {
  PageInfo& info = pages_.fields().info(page);
  info.woke_neighbours = true;
  if (count_ == 0) return;
  for (int n = 0; n < kNeighbours; ++n) {
    if (info.neighbours[n] >= kFirstPage && within_stencil(n)) wake(info.neighbours[n]);
  }
}

void QuietPages::wake_all() {
  pages_.memory().for_each_resident([&](PhysicalPage page) { wake(page); });
}

void QuietPages::put_to_sleep(PhysicalPage page) {
  HostFields& fields = pages_.fields();
  PageInfo& info = fields.info(page);
  info.asleep = true;
  ++count_;
  const int next = 1 - pages_.current();
  std::copy_n(pages_.phi(page), kPageVoxels, fields.phi(next, page));
  fields.masks(next, page) = fields.masks(pages_.current(), page);
  states_changed_ = true;
}

bool QuietPages::is_still(PhysicalPage page) const {
  if (page < kFirstPage) return true;
  const PageInfo& info = pages_.fields().info(page);
  return info.asleep || info.change <= kQuietChange;
}

bool QuietPages::surroundings_are_still(PhysicalPage page) const {
  const PageInfo& info = pages_.fields().info(page);
  for (int n = 0; n < kNeighbours; ++n) {
    if (within_stencil(n) && !is_still(info.neighbours[n])) return false;
  }
  return true;
}

void QuietPages::show(MotionWatch& watch) {
  for (const PhysicalPage page : active_) {
    PageInfo& info = pages_.fields().info(page);
    watch.add_page({static_cast<double>(info.content), static_cast<double>(info.near_voxels), info.samples},
                   info.rest);
  }
}

void QuietPages::judge() {
  if (!skip_) return;
  std::vector<PhysicalPage> quiet;
  for (const PhysicalPage page : active_) {
    if (pages_.memory().virtual_page(page) < 0) continue;  // freed in this step
    // Itself first, because it most often decides.
    if (is_still(page) && surroundings_are_still(page)) quiet.push_back(page);
  }
  for (const PhysicalPage page : quiet) put_to_sleep(page);
}

void QuietPages::begin_window() {
  for (const PhysicalPage page : active_) {
    PageInfo& info = pages_.fields().info(page);
    info.change = 0.0F;
    info.content = 0.0F;
    info.near_voxels = 0;
    info.samples = 0;
    info.woke_neighbours = false;
  }
}

// In time linear in the resident pages.
void QuietPages::refresh_active() {
  if (!active_list_is_stale()) return;
  note_changes();
  active_.clear();
  pages_.for_each_in_order([&](PhysicalPage page) {
    const PageInfo& info = pages_.fields().info(page);
    if (!info.asleep) active_.push_back(page);
  });
  states_changed_ = false;
  seen_changes_ = pages_.table().changes();
}

// Pages that were freed since are known to have changed.
void QuietPages::note_changes() const {
  if (!computed_) return;
  for (const PhysicalPage page : active_) {
    if (pages_.memory().virtual_page(page) >= 0) pages_.note_change(page);
  }
  computed_ = false;
}

std::vector<std::int64_t> QuietPages::virtual_pages() const {
  std::vector<std::int64_t> pages;
  pages_.memory().for_each_resident([&](PhysicalPage page) {
    if (pages_.fields().info(page).asleep) pages.push_back(pages_.memory().virtual_page(page));
  });
  return pages;
}

std::vector<std::int64_t> QuietPages::moving_pages(const MotionWatch& watch) const {
  std::vector<std::int64_t> pages;
  pages_.memory().for_each_resident([&](PhysicalPage page) {
    const PageInfo& info = pages_.fields().info(page);
    if (!info.asleep && watch.is_moving(info.rest)) pages.push_back(pages_.memory().virtual_page(page));
  });
  return pages;
}

std::int64_t QuietPages::state_bytes() const {
  return static_cast<std::int64_t>(active_.capacity() * sizeof(PhysicalPage));
}

Status QuietPages::validate() const {
  const PageTable& table = pages_.table();
  const HostFields& fields = pages_.fields();
  Status result;
  std::int64_t asleep = 0;
  pages_.memory().for_each_resident([&](PhysicalPage page) {
    if (!fields.info(page).asleep) return;
    ++asleep;
    if (std::equal(fields.phi(0, page), fields.phi(0, page) + kPageVoxels, fields.phi(1, page))) return;
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
    if (table.virtual_page(page) <= before || fields.info(page).asleep) {
      return fail(ErrorKind::internal, "page {} is not in its place in the list of active pages", page);
    }
    before = table.virtual_page(page);
  }
  return {};
}

}  // namespace tidemark::solver
