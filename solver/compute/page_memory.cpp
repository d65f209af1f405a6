#include "solver/compute/page_memory.h"

#include <algorithm>
#include <bit>
#include <iterator>

namespace tidemark::solver {
namespace {

// The free list is a ring, and its indices run on past 2^32: its length must divide that.
std::int64_t ring_length(std::int64_t capacity) {
  return static_cast<std::int64_t>(std::bit_ceil(static_cast<std::uint64_t>(capacity)));
}

}  // namespace

std::int64_t PageMemory::bytes_for(const PackedLayout& layout, std::int64_t capacity) {
  const std::int64_t pages = layout.rounded_up(capacity);
  const std::int64_t phi = 2 * pages * layout.layout().voxels_per_page() * 4;
  const auto state = static_cast<std::int64_t>(sizeof(ComputePageState));
  return phi + pages * (4 + state + 4) + ring_length(pages) * 4 + layout.layout().page_count() * 4 +
         static_cast<std::int64_t>(sizeof(ComputeControl));
}

Result<PageMemory> PageMemory::create(gpu::Device& device, const PackedLayout& layout, const Field& phi,
                                      std::int64_t capacity) {
  PageMemory memory;
  const std::int64_t resident = phi.pages.stored();
  auto field = PackedField::create(device, layout, std::max(capacity, resident + kFirstPage),
                                   static_cast<float>(phi.band));
  if (!field) return pass_on(field);
  memory.field_ = std::move(*field);
  memory.field_.upload(phi.pages);

  const std::int64_t pages = memory.capacity();
  std::vector<std::int32_t> table(static_cast<std::size_t>(phi.pages.size()));
  std::vector<std::int32_t> inverse(static_cast<std::size_t>(pages), -1);
  std::vector<std::int32_t> active;
  std::vector<ComputePageState> states(static_cast<std::size_t>(pages));
  for (std::size_t page = 0; page < table.size(); ++page) {
    if (const auto kind = phi.pages.kind(static_cast<std::int64_t>(page)); kind != Field::Kind::stored) {
      table[page] = kind == Field::Kind::inside ? kInsidePage : kOutsidePage;
      continue;
    }
    const auto physical = static_cast<PhysicalPage>(active.size() + kFirstPage);
    table[page] = physical;
    inverse[static_cast<std::size_t>(physical)] = static_cast<std::int32_t>(page);
    states[static_cast<std::size_t>(physical)].flags = 2;  // listed
    active.push_back(physical);
  }
  auto page_table = gpu::Buffer::create(device, static_cast<std::int64_t>(table.size()) * 4, "page table");
  if (!page_table) return pass_on(page_table);
  memory.page_table_ = std::move(*page_table);
  memory.page_table_.upload_values<std::int32_t>(0, table);
  auto control = gpu::Buffer::create(device, sizeof(ComputeControl), "control");
  if (!control) return pass_on(control);
  memory.control_ = std::move(*control);
  TIDEMARK_TRY(memory.allocate_lists(device, pages));
  memory.inverse_table_.upload_values<std::int32_t>(0, inverse);
  memory.states_.upload_values<ComputePageState>(0, states);
  memory.active_list_.upload_values<std::int32_t>(0, active);
  ComputeControl first{};
  const auto count = static_cast<std::uint32_t>(active.size());
  first.active_count = count;
  first.active_groups[0] = std::clamp<std::uint32_t>(count, 1, kGroupsPerRow);
  first.active_groups[1] = std::max<std::uint32_t>(1, (count + kGroupsPerRow - 1) / kGroupsPerRow);
  first.active_groups[2] = 1;
  std::vector<std::int32_t> free;
  for (auto page = static_cast<PhysicalPage>(active.size() + kFirstPage); page < pages; ++page) {
    free.push_back(page);
  }
  memory.list_free_pages(free, first);
  TIDEMARK_TRY(device.check("making the lists of pages"));
  return memory;
}

// Empty lists for `capacity` pages.
Status PageMemory::allocate_lists(gpu::Device& device, std::int64_t capacity) {
  auto inverse = gpu::Buffer::create(device, capacity * 4, "inverse page table");
  auto states = gpu::Buffer::create(device, capacity * static_cast<std::int64_t>(sizeof(ComputePageState)),
                                    "page states");
  auto active = gpu::Buffer::create(device, capacity * 4, "active list");
  auto free = gpu::Buffer::create(device, ring_length(capacity) * 4, "free list");
  for (auto* made : {&inverse, &states, &active, &free}) {
    if (!*made) return pass_on(*made);
  }
  const std::vector<std::int32_t> nobody(static_cast<std::size_t>(capacity), -1);
  inverse->upload_values<std::int32_t>(0, nobody);
  inverse_table_ = std::move(*inverse);
  states_ = std::move(*states);
  active_list_ = std::move(*active);
  free_list_ = std::move(*free);
  return {};
}

// The free pages are these, and `control` with them is the present one.
void PageMemory::list_free_pages(const std::vector<std::int32_t>& pages, ComputeControl& control) {
  free_list_.upload_values<std::int32_t>(0, pages);
  control.free_head = 0;
  control.free_tail = control.free_tail_ready = static_cast<std::uint32_t>(pages.size());
  write_control(control);
}

Status PageMemory::grow(gpu::Device& device, std::int64_t capacity, ComputeControl& control) {
  const std::int64_t old = this->capacity();
  const std::int64_t pages = field_.layout().rounded_up(capacity);
  std::vector<std::int32_t> free = free_pages(control);
  for (auto page = static_cast<PhysicalPage>(old); page < pages; ++page) free.push_back(page);
  TIDEMARK_TRY(device.check("growing the lists of pages"));
  PageMemory grown;
  TIDEMARK_TRY(grown.allocate_lists(device, pages));
  TIDEMARK_TRY(field_.grow(device, pages));
  grown.inverse_table_.copy_from(inverse_table_, inverse_table_.bytes());
  grown.states_.copy_from(states_, states_.bytes());
  grown.active_list_.copy_from(active_list_, active_list_.bytes());
  inverse_table_ = std::move(grown.inverse_table_);
  states_ = std::move(grown.states_);
  active_list_ = std::move(grown.active_list_);
  free_list_ = std::move(grown.free_list_);
  list_free_pages(free, control);
  return device.check("growing the lists of pages");
}

// Those that the ring holds.
std::vector<std::int32_t> PageMemory::free_pages(const ComputeControl& control) const {
  std::vector<std::int32_t> pages;
  if (control.free_pages() <= 0) return pages;
  const auto ring = free_list_.download_values<std::int32_t>(0, ring_length(capacity()));
  for (std::uint32_t i = control.free_head; i != control.free_tail; ++i)
    pages.push_back(ring[i % ring.size()]);
  return pages;
}

ComputeControl PageMemory::read_control() const {
  return control_.download_values<ComputeControl>(0, 1).front();
}

void PageMemory::write_control(const ComputeControl& control) {
  control_.upload(0, std::as_bytes(std::span(&control, 1)));
}

void PageMemory::bind() const {
  page_table_.bind_storage(0);
  inverse_table_.bind_storage(1);
  states_.bind_storage(2);
  control_.bind_storage(3);
  active_list_.bind_storage(4);
  free_list_.bind_storage(5);
}

Status PageMemory::download(int buffer, Field& phi) const {
  auto physical = field_.download(buffer);
  if (!physical) return pass_on(physical);
  const auto table = page_table_.download_values<std::int32_t>(0, phi.layout.page_count());
  update(phi, table, *physical);
  return {};
}

std::vector<std::int64_t> PageMemory::resident_pages() const {
  const auto inverse = inverse_table_.download_values<std::int32_t>(0, capacity());
  std::vector<std::int64_t> pages;
  std::copy_if(inverse.begin() + kFirstPage, inverse.end(), std::back_inserter(pages),
               [](std::int32_t page) { return page >= 0; });
  return pages;
}

template <class Wanted>
std::vector<std::int64_t> PageMemory::pages_where(Wanted wanted) const {
  const auto inverse = inverse_table_.download_values<std::int32_t>(0, capacity());
  const auto states = states_.download_values<ComputePageState>(0, capacity());
  std::vector<std::int64_t> pages;
  for (std::size_t page = kFirstPage; page < inverse.size(); ++page) {
    if (inverse[page] >= 0 && wanted(states[page])) pages.push_back(inverse[page]);
  }
  return pages;
}

std::vector<std::int64_t> PageMemory::sleeping_pages() const {
  return pages_where([](const ComputePageState& page) { return page.is_asleep(); });
}

std::vector<std::int64_t> PageMemory::moving_pages(const RestRule& rule) const {
  const ComputeControl control = read_control();
  return pages_where([&](const ComputePageState& page) {
    return !page.is_asleep() && rule.is_moving(page.moved, control.first_window, control.window - 1);
  });
}

Status PageMemory::validate() const {
  const ComputeControl control = read_control();
  const auto table = page_table_.download_values<std::int32_t>(0, field_.layout().layout().page_count());
  const auto inverse = inverse_table_.download_values<std::int32_t>(0, capacity());
  std::vector<int> seen(inverse.size());
  std::int64_t resident = 0;
  for (std::size_t page = 0; page < table.size(); ++page) {
    const std::int32_t entry = table[page];
    if (entry == kOutsidePage || entry == kInsidePage) continue;
    if (entry < kFirstPage || entry >= capacity()) {
      return fail(ErrorKind::internal, "page table: page {} maps to page {} of {}", page, entry, capacity());
    }
    const auto physical = static_cast<std::size_t>(entry);
    if (inverse[physical] != static_cast<std::int32_t>(page)) {
      return fail(ErrorKind::internal, "page table: page {} maps to {}, which maps back to {}", page, entry,
                  inverse[physical]);
    }
    ++resident;
    ++seen[physical];
  }
  for (const std::int32_t free : free_pages(control)) {
    const auto page = static_cast<std::size_t>(free);
    if (page >= seen.size() || ++seen[page] > 1 || inverse[page] != -1) {
      return fail(ErrorKind::internal, "free list: page {} is in use or there twice", page);
    }
  }
  if (resident + control.free_pages() + kFirstPage != capacity()) {
    return fail(ErrorKind::internal, "{} pages in use, {} free and {} static are not the capacity of {}",
                resident, control.free_pages(), kFirstPage, capacity());
  }
  return {};
}

}  // namespace tidemark::solver
