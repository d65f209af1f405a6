#include "solver/paging/page_table.h"

#include <cassert>

namespace tidemark::solver {

PageTable::PageTable(std::int64_t pages)
    : table_(static_cast<std::size_t>(pages), kOutsidePage), inverse_(kFirstPage, -1) {}

PhysicalPage PageTable::allocate(std::int64_t page) {
  assert(is_static_page(physical(page)));
  PhysicalPage found = capacity();
  if (free_.empty()) {
    inverse_.push_back(page);
  } else {
    found = free_.back();
    free_.pop_back();
    inverse_[static_cast<std::size_t>(found)] = page;
  }
  table_[static_cast<std::size_t>(page)] = found;
  ++changes_;
  return found;
}

void PageTable::release(std::int64_t page, bool inside) {
  const PhysicalPage freed = physical(page);
  assert(!is_static_page(freed));
  inverse_[static_cast<std::size_t>(freed)] = -1;
  free_.push_back(freed);
  table_[static_cast<std::size_t>(page)] = inside ? kInsidePage : kOutsidePage;
  ++changes_;
}

void PageTable::set_static(std::int64_t page, bool inside) {
  assert(is_static_page(physical(page)));
  table_[static_cast<std::size_t>(page)] = inside ? kInsidePage : kOutsidePage;
  ++changes_;
}

std::int64_t PageTable::bytes() const {
  return static_cast<std::int64_t>(table_.capacity() * sizeof(PhysicalPage) +
                                   inverse_.capacity() * sizeof(std::int64_t) +
                                   free_.capacity() * sizeof(PhysicalPage));
}

Status PageTable::validate() const {
  std::int64_t resident_entries = 0;
  for (std::int64_t page = 0; page < std::ssize(table_); ++page) {
    const PhysicalPage entry = physical(page);
    if (is_static_page(entry)) continue;
    ++resident_entries;
    if (entry < kFirstPage || entry >= capacity()) {
      return fail(ErrorKind::internal, "page table: page {} maps to page {} of {}", page, entry, capacity());
    }
    if (virtual_page(entry) != page) {
      return fail(ErrorKind::internal, "page table: page {} maps to {}, which maps back to {}", page, entry,
                  virtual_page(entry));
    }
  }
  if (resident_entries != resident()) {
    return fail(ErrorKind::internal, "page table: {} pages are mapped, {} are in use", resident_entries,
                resident());
  }
  std::vector<bool> seen(inverse_.size());
  for (const PhysicalPage page : free_) {
    if (virtual_page(page) != -1 || seen[static_cast<std::size_t>(page)]) {
      return fail(ErrorKind::internal, "free list: page {} is in use or there twice", page);
    }
    seen[static_cast<std::size_t>(page)] = true;
  }
  return {};
}

}  // namespace tidemark::solver
