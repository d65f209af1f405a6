// Prefetches of the memory that computing a page will read, while other pages are computed.
#pragma once

#include <cstddef>

#include "solver/host/host_fields.h"

namespace tidemark::solver {

// A list of cache lines. They are brought into the second-level cache: the first would be too small.
class PagePrefetch {
  // Lines are asked for in fours, because the end of a loop over them would be mispredicted.
  struct Four {
    const float* first;
    std::ptrdiff_t step;  // floats from line to line
  };

 public:
  // All that is kept for each voxel of the page. To be called at most once, like the next one.
  void add_values(const HostFields& fields, PhysicalPage page);
  // The rows of the neighbours along y and z that touch the page. Those along x lie beside it in memory as a
  // rule, and are brought by themselves.
  void add_neighbours(const HostFields& fields, int buffer, PhysicalPage page);

  // Asks for everything a few lines at a time: asked for at once they would fill the processor's queue of
  // loads, and the computation would wait behind them.
  class Turns {
   public:
    // `count` is how often go_on() will be called, at least 1.
    Turns(const PagePrefetch& prefetch, int count)
        : next_(prefetch.fours_),
          end_(prefetch.fours_ + prefetch.count_),
          fours_a_turn_((prefetch.count_ + count - 1) / count) {}
    void go_on() {
      for (int i = 0; i < fours_a_turn_ && next_ != end_; ++i, ++next_) {
        for (int line = 0; line < 4; ++line) __builtin_prefetch(next_->first + line * next_->step, 0, 2);
      }
    }

   private:
    const Four* next_;
    const Four* end_;
    int fours_a_turn_;
  };

 private:
  static constexpr int kFloatsPerLine = 16;
  static constexpr int kFoursOfValues = HostFields::kFloatsPerPage / (4 * kFloatsPerLine);
  static_assert(HostFields::kFloatsPerPage % (4 * kFloatsPerLine) == 0);
  static constexpr int kFoursOfNeighbours = 2 * 3 * (1 + 2);

  void add(const float* first, std::ptrdiff_t step) { fours_[count_++] = {first, step}; }

  Four fours_[kFoursOfValues + kFoursOfNeighbours];  // the first count_
  int count_ = 0;
};

}  // namespace tidemark::solver
