// Quiet pages of the stream executor: where nothing moves, nothing is drawn.
//
// A page is still when phi changed by at most kQuietChange in it over a window of steps, judged beside the
// surface. It sleeps when it and the pages around it are still, and wakes as soon as one of them moves.
// "Around" is as far as the band reaches: these pages are one slice thick, so that the surface on which a
// page's values depend may lie several pages below or above it.
#include <cmath>

#include "solver/convergence.h"
#include "solver/stream/pages_around.h"
#include "solver/stream/stream_executor.h"

namespace tidemark::solver {

void StreamExecutor::wake(PhysicalPage page) {
  if (!info(page).asleep) return;
  info(page).asleep = false;
  active_list_is_stale_ = true;
}

void StreamExecutor::wake_around(PhysicalPage page) {
  info(page).woke_neighbours = true;
  if (!std::isfinite(band())) return;  // nothing sleeps then
  all_within(band_reach(), pages_.layout().page_coordinates(pages_.virtual_page(page)),
             [&](Index3 coordinates) {
               const PhysicalPage other = pages_.physical(coordinates);
               if (other >= kFirstPage) wake(other);
               return true;
             });
}

// The sums of a window begin.
void StreamExecutor::begin_window() {
  steps_in_window_ = 0;
  for (const PhysicalPage page : active_) info(page).woke_neighbours = false;
  memory_.draw_into_motion();
  gpu::clear_colours(1);
}

// Ends the window of steps over which motion is summed up, when this step does: judges convergence and which
// pages are quiet. Returns whether it did.
Result<bool> StreamExecutor::finish_window() {
  if (++steps_in_window_ < kConvergenceWindow) return false;
  if (!active_.empty()) {
    auto pages = memory_.read_motion();
    if (!pages) return pass_on(pages);
    for (const PhysicalPage page : active_) {
      const PageMotion& moved = (*pages)[static_cast<std::size_t>(page)];
      const PageContent content{static_cast<double>(moved.content), static_cast<double>(moved.near_voxels),
                                static_cast<int>(moved.samples)};
      watch_.add_page(content, info(page).rest);
    }
    TIDEMARK_TRY(judge_quiet_pages(*pages));
  }
  watch_.end_window();
  begin_window();
  return true;
}

Status StreamExecutor::judge_quiet_pages(const std::vector<PageMotion>& motion) {
  const auto still = [&](Index3 coordinates) {
    const PhysicalPage page = pages_.physical(coordinates);
    return page < kFirstPage || info(page).asleep ||
           motion[static_cast<std::size_t>(page)].change <= kQuietChange;
  };
  const Index3 reach = band_reach();
  std::vector<PhysicalPage> quiet;
  // A page that waits for a page must not sleep over it.
  if (options_.skip_quiet_pages && !needs_activation_ && std::isfinite(band())) {
    for (const PhysicalPage page : active_) {
      if (pages_.virtual_page(page) < 0) continue;  // freed in this step
      if (all_within(reach, pages_.layout().page_coordinates(pages_.virtual_page(page)), still))
        quiet.push_back(page);
    }
  }
  if (quiet.empty()) return {};
  for (const PhysicalPage page : quiet) info(page).asleep = true;
  active_list_is_stale_ = true;
  TIDEMARK_TRY(special_geometry_.describe(*device_, pages_, quiet));
  passes_.copy(special_geometry_, memory_, current_);
  return {};
}

Result<std::vector<std::int64_t>> StreamExecutor::quiet_pages() const {
  std::vector<std::int64_t> pages;
  pages_.for_each_resident([&](PhysicalPage page) {
    if (info(page).asleep) pages.push_back(pages_.virtual_page(page));
  });
  return pages;
}

Result<std::vector<std::int64_t>> StreamExecutor::moving_pages() const {
  std::vector<std::int64_t> pages;
  pages_.for_each_resident([&](PhysicalPage page) {
    if (!info(page).asleep && watch_.is_moving(info(page).rest)) pages.push_back(pages_.virtual_page(page));
  });
  return pages;
}

Status StreamExecutor::rebuild_active_list() {
  active_.clear();
  quiet_pages_ = 0;
  pages_.for_each_resident([&](PhysicalPage page) {
    if (info(page).asleep) {
      ++quiet_pages_;
    } else {
      active_.push_back(page);
    }
  });
  TIDEMARK_TRY(passes_.reserve(*device_, static_cast<std::int64_t>(active_.size())));
  TIDEMARK_TRY(active_geometry_.describe(*device_, pages_, active_));
  active_list_is_stale_ = false;
  return {};
}

}  // namespace tidemark::solver
