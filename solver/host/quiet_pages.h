// Quiet pages: where nothing moves, nothing is computed.
//
// A page is still when phi changed by at most kQuietChange in it over a window of steps, judged beside the
// surface. It sleeps when it and the 18 pages around it (faces and edges, as far as the stencil reaches) are
// still, and wakes as soon as one of them moves. A threshold on single steps would freeze slow fronts.
#pragma once

#include <vector>

#include "solver/convergence.h"
#include "solver/host/resident_pages.h"

namespace tidemark::solver {

class QuietPages {
 public:
  // With `skip` false no page ever sleeps. `pages` outlives it.
  QuietPages(ResidentPages& pages, bool skip) : pages_(pages), skip_(skip) {}
  // After all pages were given back.
  void clear();

  // The pages that are computed, in the order of their virtual numbers: each thread's share is then one
  // region of the surface, and few of its pages are beside one that another thread writes. As they were when
  // refresh_active() was last called.
  [[nodiscard]] const std::vector<PhysicalPage>& active() const { return active_; }
  void refresh_active();
  // The active pages have been computed.
  void computed() { computed_ = true; }
  // Notes what was computed as changed.
  void note_changes() const;

  void wake_around(PhysicalPage page);
  void wake_all();

  // At the end of a window, before judge(): shows the watch what moved.
  void show(MotionWatch& watch);
  // At the end of a window: puts pages to sleep.
  void judge();
  // The sums of a window begin.
  void begin_window();

  [[nodiscard]] std::int64_t count() const { return count_; }
  [[nodiscard]] std::vector<std::int64_t> virtual_pages() const;
  [[nodiscard]] std::vector<std::int64_t> moving_pages(const MotionWatch& watch) const;
  [[nodiscard]] std::int64_t state_bytes() const;
  [[nodiscard]] Status validate() const;

 private:
  [[nodiscard]] bool active_list_is_stale() const {
    return states_changed_ || seen_changes_ != pages_.table().changes();
  }
  void wake(PhysicalPage page);
  void put_to_sleep(PhysicalPage page);
  [[nodiscard]] bool is_still(PhysicalPage page) const;
  [[nodiscard]] bool surroundings_are_still(PhysicalPage page) const;

  ResidentPages& pages_;
  bool skip_;
  std::vector<PhysicalPage> active_;
  bool states_changed_ = true;      // pages fell asleep or woke since the active list was made
  std::int64_t seen_changes_ = -1;  // of the page table, when it was
  mutable bool computed_ = false;   // the active pages were, and are not noted as changed
  std::int64_t count_ = 0;
};

}  // namespace tidemark::solver
