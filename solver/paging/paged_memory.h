// Memory in pages over a domain of 2, 3 or 4 dimensions: a page table, and any number of fields whose pages
// lie at the physical numbers that it gives (paper sections 3.2, 4.1 and 7).
#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "core/paging/page_layout.h"
#include "core/result.h"
#include "solver/paging/changed_pages.h"
#include "solver/paging/page_field.h"
#include "solver/paging/page_table.h"

namespace tidemark::solver {

// A budget for memories whose owner counts by itself.
inline constexpr std::int64_t kUnlimited = std::numeric_limits<std::int64_t>::max();

// Memory follows the pages that are resident: a field is address space, which takes memory where it is first
// written. A page that is freed keeps its memory for the page that comes next.
//
//     PagedMemory<3> memory(PageLayout(size, {8, 8, 8}), budget);
//     PageField<float> phi = memory.attach<float>(2);              // two buffers, a value a voxel
//     phi.fill(kInsidePage, band), phi.fill(kOutsidePage, -band);  // what stands for other pages
//     const PhysicalAddress at = memory.translate(voxel);
//     phi.values(at.page)[at.offset];
template <int kDimensions>
class PagedMemory {
 public:
  using Layout = BasicPageLayout<kDimensions>;
  using Coordinates = Index<kDimensions>;

  PagedMemory() = default;
  // Everything is outside. `budget`: the bytes that the tables and all fields may take.
  PagedMemory(const Layout& layout, std::int64_t budget);

  // A field with a value for each voxel, or with `values` T's a page. Address space is reserved for as many
  // pages as the domain has or the budget allows. Throws OutOfMemory where that cannot be had.
  template <class T>
  [[nodiscard]] PageField<T> attach(std::int64_t buffers = 1) {
    return attached<PageField<T>>(layout_.voxels_per_page(), buffers, sizeof(T));
  }
  template <class T, std::int64_t kValues, std::int64_t kBuffers = 1>
  [[nodiscard]] PageField<T, kValues, kBuffers> attach() {
    return attached<PageField<T, kValues, kBuffers>>(kValues, kBuffers, sizeof(T));
  }
  // Gives the memory of a field back.
  template <class Field>
  void detach(Field& field) {
    page_bytes_ -= field.page_bytes();
    field = Field();
  }

  [[nodiscard]] const Layout& layout() const { return layout_; }
  [[nodiscard]] const PageTable& table() const { return table_; }
  // Of a page of V_P by its number, or by its coordinates: then kNoPage beyond V_P's border.
  [[nodiscard]] PhysicalPage physical(std::int64_t page) const { return table_.physical(page); }
  [[nodiscard]] PhysicalPage physical(Coordinates page) const {
    return layout_.contains_page(page) ? physical(layout_.page_number(page)) : kNoPage;
  }
  [[nodiscard]] std::int64_t virtual_page(PhysicalPage page) const { return table_.virtual_page(page); }
  // Where every field has the values of a voxel of the domain.
  struct PhysicalAddress {
    PhysicalPage page = kOutsidePage;
    std::int64_t offset = 0;
  };
  [[nodiscard]] PhysicalAddress translate(Coordinates voxel) const {
    const VirtualAddress address = layout_.translate(voxel);
    return {physical(address.page), address.offset};
  }

  // Makes a page that is not resident resident; its values are the caller's to write. Fails
  // (ErrorKind::capability) when that is above the budget.
  Result<PhysicalPage> make_resident(std::int64_t page);
  // As PageTable says.
  void release(std::int64_t page, bool inside);
  void set_static(std::int64_t page, bool inside);
  // Fails (ErrorKind::capability) when so many more pages are above the budget, with fields of so many more
  // bytes a page.
  [[nodiscard]] Status check_budget(std::int64_t more_pages, std::int64_t more_page_bytes = 0) const;

  // Calls visit(physical page) for the resident ones.
  template <class Visit>
  void for_each_resident(Visit visit) const {
    for (PhysicalPage page = kFirstPage; page < table_.capacity(); ++page) {
      if (table_.virtual_page(page) >= 0) visit(page);
    }
  }

  // Pages announce their changes from now on: those that come or go do so by themselves, and what writes into
  // a field says so.
  void announce_changes() { changed_ = ChangedPages(layout_.page_count()); }
  void note_change(std::int64_t page) const {
    if (changed_) changed_->add(page);
  }
  // Calls visit(virtual page) for each of them since the last call, in any order.
  template <class Visit>
  void take_changes(const Visit& visit) const {
    if (changed_) changed_->take(visit);
  }

  // The same for others who look now and then: what changes from here on has changed since the moment that
  // this returns. In memory that announces nothing everything has.
  [[nodiscard]] ChangedPages::Moment end_moment() const { return changed_ ? changed_->end_moment() : 0; }
  [[nodiscard]] bool has_changed_since(std::int64_t page, ChangedPages::Moment moment) const {
    return !changed_ || changed_->has_changed_since(page, moment);
  }

  // Of the fields, of the tables and lists, and the most pages that were resident at once.
  [[nodiscard]] std::int64_t field_bytes() const { return table_.capacity() * page_bytes_; }
  [[nodiscard]] std::int64_t table_bytes() const { return table_.bytes(); }
  [[nodiscard]] std::int64_t peak_resident() const { return peak_resident_; }

 private:
  template <class Field>
  [[nodiscard]] Field attached(std::int64_t values, std::int64_t buffers, std::size_t bytes) {
    Field field(most_pages(values * buffers * static_cast<std::int64_t>(bytes)), values, buffers);
    page_bytes_ += field.page_bytes();
    return field;
  }
  // That fields of so many bytes a page may ever have, the static ones included.
  [[nodiscard]] std::int64_t most_pages(std::int64_t bytes_a_page) const;

  Layout layout_;
  std::int64_t budget_ = 0;
  std::int64_t page_bytes_ = 0;  // of all fields
  PageTable table_;
  std::int64_t peak_resident_ = 0;
  mutable std::optional<ChangedPages> changed_;  // unset: nobody asks
};

extern template class PagedMemory<2>;
extern template class PagedMemory<3>;
extern template class PagedMemory<4>;

}  // namespace tidemark::solver
