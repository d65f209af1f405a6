#include "solver/paging/paged_memory.h"

#include <algorithm>
#include <limits>

namespace tidemark::solver {

template <int kDimensions>
PagedMemory<kDimensions>::PagedMemory(const Layout& layout, std::int64_t budget)
    : layout_(layout), budget_(budget), table_(layout.page_count()) {}

template <int kDimensions>
std::int64_t PagedMemory<kDimensions>::most_pages(std::int64_t bytes_a_page) const {
  const std::int64_t affordable = std::min(budget_ / bytes_a_page, layout_.page_count()) + 1 + kFirstPage;
  return std::max<std::int64_t>(affordable, table_.capacity());
}

template <int kDimensions>
Status PagedMemory<kDimensions>::check_budget(std::int64_t more_pages, std::int64_t more_page_bytes) const {
  const std::int64_t capacity =
      std::max<std::int64_t>(table_.capacity(), table_.capacity() + more_pages - table_.free_count());
  // The lists and tables that grow with the pages take at most this much more for each, their reserve
  // included. They count by that and not as they are: pages that are let in together find room one by one.
  constexpr std::int64_t kListBytesPerPage = 64;
  const std::int64_t table_bytes = layout_.page_count() * static_cast<std::int64_t>(sizeof(PhysicalPage));
  const std::int64_t bytes = capacity * (page_bytes_ + more_page_bytes + kListBytesPerPage) + table_bytes;
  if (bytes <= budget_ && capacity <= std::numeric_limits<PhysicalPage>::max()) return {};
  return fail(ErrorKind::capability, "the surface needs {} pages, {} MB, and the memory budget is {} MB",
              capacity, bytes >> 20, budget_ >> 20);
}

template <int kDimensions>
Result<PhysicalPage> PagedMemory<kDimensions>::make_resident(std::int64_t page) {
  if (table_.free_count() == 0) {
    TIDEMARK_TRY(check_budget(1));
  }
  const PhysicalPage physical = table_.allocate(page);
  note_change(page);
  peak_resident_ = std::max(peak_resident_, table_.resident());
  return physical;
}

template <int kDimensions>
void PagedMemory<kDimensions>::release(std::int64_t page, bool inside) {
  table_.release(page, inside);
  note_change(page);
}

template <int kDimensions>
void PagedMemory<kDimensions>::set_static(std::int64_t page, bool inside) {
  table_.set_static(page, inside);
  note_change(page);
}

template class PagedMemory<2>;
template class PagedMemory<3>;
template class PagedMemory<4>;

}  // namespace tidemark::solver
