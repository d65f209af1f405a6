// The virtual pages that have changed: a list since it was last taken, and for each page the moment of its
// last change.
#pragma once

#include <atomic>
#include <cstdint>
#include <utility>
#include <vector>

namespace tidemark::solver {

class ChangedPages {
 public:
  // A moment in the life of all page tables of the program; later ones are greater.
  using Moment = std::uint64_t;

  // Of a table of so many virtual pages, none of them changed. An observer who knows moments of earlier
  // tables alone finds that all have.
  explicit ChangedPages(std::int64_t pages)
      : taken_at_(next_moment()),
        now_(next_moment()),
        changed_at_(static_cast<std::size_t>(pages), taken_at_) {}

  void add(std::int64_t page) {
    Moment& at = changed_at_[static_cast<std::size_t>(page)];
    if (at <= taken_at_) listed_.push_back(page);
    at = now_;
  }

  // Calls visit(page) for each of them since the last call, in any order.
  template <class Visit>
  void take(const Visit& visit) {
    for (const std::int64_t page : listed_) visit(page);
    listed_.clear();
    taken_at_ = end_moment();
  }

  // Ends the present moment: what changes from here on has changed since it.
  Moment end_moment() { return std::exchange(now_, next_moment()); }
  [[nodiscard]] bool has_changed_since(std::int64_t page, Moment moment) const {
    return changed_at_[static_cast<std::size_t>(page)] > moment;
  }

 private:
  static Moment next_moment() {
    static std::atomic<Moment> last = 0;
    return ++last;
  }

  Moment taken_at_;
  Moment now_;
  std::vector<Moment> changed_at_;
  std::vector<std::int64_t> listed_;
};

}  // namespace tidemark::solver
