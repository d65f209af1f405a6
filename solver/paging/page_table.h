// The page table: which virtual pages are in physical memory, and where (paper sections 3.2 and 4.1).
#pragma once

#include <cstdint>
#include <vector>

#include "core/result.h"

namespace tidemark::solver {

// The number of a physical page. Two pages are static: everything that is not resident maps to one of them.
using PhysicalPage = std::int32_t;
inline constexpr PhysicalPage kOutsidePage = 0;
inline constexpr PhysicalPage kInsidePage = 1;
inline constexpr PhysicalPage kFirstPage = 2;  // of those that are allocated and freed
inline constexpr PhysicalPage kNoPage = -1;    // beyond the domain's border

constexpr bool is_static_page(PhysicalPage page) {
  return page == kOutsidePage || page == kInsidePage;
}

// How many steps in a row a page must be constant before it is freed: a front that hovers at its edge would
// otherwise allocate and free it all the time.
inline constexpr int kConstantStepsBeforeRelease = 2;

// The page table V_P -> G_P, the inverse page table G_P -> V_P and the free-page stack.
class PageTable {
 public:
  PageTable() = default;
  // Of so many virtual pages. Everything is outside.
  explicit PageTable(std::int64_t pages);

  // The physical page of a virtual one.
  [[nodiscard]] PhysicalPage physical(std::int64_t page) const {
    return table_[static_cast<std::size_t>(page)];
  }
  // The virtual page that a physical one holds; -1 when it is free or static.
  [[nodiscard]] std::int64_t virtual_page(PhysicalPage page) const {
    return inverse_[static_cast<std::size_t>(page)];
  }

  // Physical pages that exist, the static ones included. Grows by one when no page is free.
  [[nodiscard]] PhysicalPage capacity() const { return static_cast<PhysicalPage>(inverse_.size()); }
  [[nodiscard]] std::int64_t resident() const { return capacity() - kFirstPage - free_count(); }
  [[nodiscard]] std::int64_t free_count() const { return static_cast<std::int64_t>(free_.size()); }

  // Makes a page that is not resident resident, on the free page used last, else on a new one.
  PhysicalPage allocate(std::int64_t page);
  // Gives a resident page back; it is static from then on.
  void release(std::int64_t page, bool inside);
  // Sets the static page that stands for a page that is not resident.
  void set_static(std::int64_t page, bool inside);

  [[nodiscard]] std::int64_t bytes() const;

  // The physical pages of all virtual ones, and how often that has changed.
  [[nodiscard]] const std::vector<PhysicalPage>& entries() const { return table_; }
  [[nodiscard]] std::int64_t changes() const { return changes_; }

  // The tables agree both ways, used and free pages make up the capacity, and no page is there twice.
  [[nodiscard]] Status validate() const;

 private:
  std::vector<PhysicalPage> table_;
  std::vector<std::int64_t> inverse_;
  std::vector<PhysicalPage> free_;  // a stack
  std::int64_t changes_ = 0;
};

}  // namespace tidemark::solver
