// The computational domain of the stream executor (paper section 4.4): pages are allocated and freed from the
// messages that the pages send.
#include <algorithm>

#include "solver/paging/page_neighbours.h"
#include "solver/paging/validate.h"
#include "solver/stream/stream_executor.h"

namespace tidemark::solver {
// Of G, the tables and the geometry; the intermediate buffers are pooled and come on top.
std::int64_t StreamExecutor::state_bytes(std::int64_t capacity) const {
  const auto beside = static_cast<std::int64_t>(sizeof(PageInfo) + sizeof(PhysicalPage));
  return PhysicalMemory::bytes_for(layout_, capacity) + GeometryEngine::bytes_for(capacity) +
         pages_.table_bytes() + capacity * beside;
}

Status StreamExecutor::make_room(std::int64_t more_pages) {
  const std::int64_t needed =
      pages_.table().capacity() + std::max<std::int64_t>(0, more_pages - pages_.table().free_count());
  if (needed <= memory_.capacity()) return {};
  const std::int64_t present = state_bytes(memory_.capacity());
  auto capacity =
      capacity_for(needed, true, [&](std::int64_t pages) { return state_bytes(pages) + present; });
  if (!capacity) return pass_on(capacity);
  TIDEMARK_TRY(memory_.grow(*device_, *capacity));
  peak_bytes_ = std::max(peak_bytes_, with_textures(state_bytes(memory_.capacity())));
  return {};
}

// Makes a page resident with the constant that stood for it. Its voxels are written by fill_new_pages().
Result<PhysicalPage> StreamExecutor::make_resident(std::int64_t virtual_page) {
  TIDEMARK_TRY(make_room(1));
  const bool inside = pages_.physical(virtual_page) == kInsidePage;
  const Result<PhysicalPage> made = pages_.make_resident(virtual_page);
  TIDEMARK_TRY(made);
  const PhysicalPage page = *made;
  info(page) = PageInfo();
  new_[inside ? 1 : 0].push_back(page);
  peak_resident_ = std::max(peak_resident_, pages_.table().resident());
  active_list_is_stale_ = true;
  return page;
}

// A bit a face: the page across it is wanted, and not resident.
std::uint8_t StreamExecutor::requests(PhysicalPage page, PageMessage message) const {
  if (!message.differs_across_any()) return 0;
  const Index3 coordinates = pages_.layout().page_coordinates(pages_.virtual_page(page));
  unsigned faces = 0;
  for (int face = 0; face < kFaces; ++face) {
    if (message.differs_across(face) && is_static_page(pages_.physical(coordinates + kFaceSteps[face])))
      faces |= 1U << face;
  }
  return static_cast<std::uint8_t>(faces);
}

Status StreamExecutor::grant_requests(PhysicalPage page, std::uint8_t requests) {
  if (requests == 0) return {};
  const PageLayout& layout = pages_.layout();
  const Index3 coordinates = layout.page_coordinates(pages_.virtual_page(page));
  for (int face = 0; face < kFaces; ++face) {
    if ((requests >> face & 1U) == 0) continue;
    TIDEMARK_TRY(make_resident(layout.page_number(coordinates + kFaceSteps[face])));
  }
  return {};
}

PageDecision StreamExecutor::decide(PhysicalPage page, PageMessage message) const {
  PageDecision decision;
  decision.allocates = requests(page, message);
  decision.wakes_around = message.moved() && !info(page).woke_neighbours;
  if (message.is_mixed()) return decision;
  decision.constant_steps =
      static_cast<std::uint8_t>(std::min(info(page).constant_steps + 1, kConstantStepsBeforeRelease));
  decision.frees = decision.constant_steps == kConstantStepsBeforeRelease && !message.differs_across_any();
  return decision;
}

Status StreamExecutor::fill_new_pages() {
  for (const bool inside : {false, true}) {
    std::vector<PhysicalPage>& pages = new_[inside ? 1 : 0];
    if (pages.empty()) continue;
    TIDEMARK_TRY(special_geometry_.describe(*device_, pages_, pages));
    passes_.fill(special_geometry_, memory_, static_cast<float>(inside ? band() : -band()));
    pages.clear();
  }
  return {};
}

void StreamExecutor::release_page(PhysicalPage page, bool inside) {
  pages_.release(pages_.virtual_page(page), inside);
  active_list_is_stale_ = true;
}

// Maintenance after a step: grants the requests, frees pages that have become constant, wakes neighbours of
// pages that move. Fails when the budget does not allow a page; what could be done is done then.
Status StreamExecutor::update_domain(const std::vector<PageMessage>& messages) {
  Status result;
  for (std::size_t i = 0; i < active_.size(); ++i) {
    const PhysicalPage page = active_[i];
    const PageDecision decision = decide(page, messages[i]);
    if (decision.allocates != 0 && result) {
      result = grant_requests(page, decision.allocates);
      needs_activation_ = !result;
    }
    if (decision.wakes_around) wake_around(page);
    info(page).constant_steps = decision.constant_steps;
    if (decision.frees) release_page(page, messages[i].is_inside());
  }
  const Status filled = fill_new_pages();
  return result ? filled : result;
}

std::vector<PhysicalPage> StreamExecutor::resident_pages() const {
  std::vector<PhysicalPage> pages;
  pages_.for_each_resident([&](PhysicalPage page) { pages.push_back(page); });
  return pages;
}

// Grants every request of the present phi, after it was replaced or painted; `asked` are the pages that may
// have some.
Status StreamExecutor::activate_pages(std::vector<PhysicalPage> asked, NoRoom no_room) {
  needs_activation_ = true;
  // Pages that are made resident on the way may ask for more.
  while (!asked.empty()) {
    TIDEMARK_TRY(special_geometry_.describe(*device_, pages_, asked));
    TIDEMARK_TRY(passes_.reserve(*device_, special_geometry_.size()));
    auto messages =
        passes_.message(special_geometry_, memory_, current_, static_cast<float>(band()), kQuietChange);
    if (!messages) return pass_on(messages);
    Status result;
    for (std::size_t i = 0; i < asked.size() && result; ++i)
      result = grant_requests(asked[i], requests(asked[i], (*messages)[i]));
    asked = new_[0];
    asked.insert(asked.end(), new_[1].begin(), new_[1].end());
    TIDEMARK_TRY(fill_new_pages());
    if (!result) return no_room == NoRoom::fails ? result : device_->check("making pages resident");
  }
  needs_activation_ = false;
  return device_->check("making pages resident");
}

Status StreamExecutor::validate_sleeping_pages() const {
  auto first = memory_.field().download(0);
  auto second = memory_.field().download(1);
  if (!first) return pass_on(first);
  if (!second) return pass_on(second);
  const auto differs = [&](PhysicalPage page, Index3 valid) {
    const auto begin = static_cast<std::size_t>(page * layout_.layout().voxels_per_page());
    for (std::int64_t i = 0; i < valid.x * valid.y; ++i) {
      const auto at =
          begin + static_cast<std::size_t>(i % valid.x + i / valid.x * layout_.layout().page_shape().x);
      if ((*first)[at] != (*second)[at]) return true;
    }
    return false;
  };
  Status result;
  pages_.for_each_resident([&](PhysicalPage page) {
    if (!result || !info(page).asleep ||
        !differs(page, pages_.layout().valid_shape(pages_.virtual_page(page))))
      return;
    result = fail(ErrorKind::internal, "page {} is quiet, but its two buffers differ", page);
  });
  for (const PhysicalPage page : {kOutsidePage, kInsidePage}) {
    const auto constant = static_cast<float>(page == kInsidePage ? band() : -band());
    for (std::int64_t i = 0; i < layout_.layout().voxels_per_page() && result; ++i) {
      const auto at = static_cast<std::size_t>(page * layout_.layout().voxels_per_page() + i);
      if ((*first)[at] == constant && (*second)[at] == constant) continue;
      result = fail(ErrorKind::internal, "static page {} is not constant", page);
    }
  }
  return result;
}

Status StreamExecutor::validate() const {
  TIDEMARK_TRY(device_->make_current());
  TIDEMARK_TRY(pages_.table().validate());
  if (pages_.table().capacity() > memory_.capacity()) {
    return fail(ErrorKind::internal, "the tables hold {} pages, G {}", pages_.table().capacity(),
                memory_.capacity());
  }
  TIDEMARK_TRY(validate_sleeping_pages());
  auto phi = snapshot();
  if (!phi) return pass_on(phi);
  return tidemark::solver::validate(*phi);
}

}  // namespace tidemark::solver
