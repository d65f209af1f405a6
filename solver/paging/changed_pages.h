// The virtual pages that have changed since they were last asked for.
#pragma once

#include <cstdint>
#include <vector>

namespace tidemark::solver {

class ChangedPages {
 public:
  // Of a table of so many virtual pages, none of them changed.
  explicit ChangedPages(std::int64_t pages) : is_listed_(static_cast<std::size_t>(pages), false) {}

  void add(std::int64_t page) {
    const auto at = static_cast<std::size_t>(page);
    if (is_listed_[at]) return;
    is_listed_[at] = true;
    listed_.push_back(page);
  }

  // Calls visit(page) for each of them, in any order; then there are none.
  template <class Visit>
  void take(const Visit& visit) {
    for (const std::int64_t page : listed_) {
      visit(page);
      is_listed_[static_cast<std::size_t>(page)] = false;
    }
    listed_.clear();
  }

 private:
  std::vector<bool> is_listed_;
  std::vector<std::int64_t> listed_;
};

}  // namespace tidemark::solver
