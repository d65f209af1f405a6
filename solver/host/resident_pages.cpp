#include "solver/host/resident_pages.h"

#include "solver/host/page_code.h"
#include "solver/host/step_motion.h"
#include "solver/paging/page_neighbours.h"

namespace tidemark::solver {

ResidentPages::ResidentPages(const Contents& contents, ThreadPool& threads, std::int64_t memory_budget)
    : contents_(contents), threads_(threads), memory_budget_(memory_budget) {
  clear();
}

float ResidentPages::constant(bool inside) const {
  return static_cast<float>(inside ? contents_.model.band() : -contents_.model.band());
}

void ResidentPages::clear() {
  memory_ = PagedMemory<3>(PageLayout(contents_.geometry.size, kDefaultPageShape), memory_budget_);
  memory_.announce_changes();
  fields_ = HostFields(memory_);
  fields_.keep_advection(contents_.speed->advects());
  for (const PhysicalPage page : {kOutsidePage, kInsidePage}) {
    const bool inside = page == kInsidePage;
    for (const int buffer : {0, 1}) {
      std::fill_n(fields_.phi(buffer, page), kPageVoxels, constant(inside));
      fields_.masks(buffer, page) = RowMasks::constant(inside);
    }
  }
  current_ = 0;
  new_pages_.clear();
  listed_.clear();
  listed_in_order_ = 0;
  needs_activation_ = false;
  known_ = Field::empty(contents_.geometry, contents_.model.band());
}

Field ResidentPages::copy() const {
  Field field = known_;
  memory_.take_changes([&](std::int64_t page) {
    const PhysicalPage physical = memory_.physical(page);
    if (is_static_page(physical)) {
      field.pages.set_constant(page, physical == kInsidePage ? Field::Kind::inside : Field::Kind::outside);
    } else {
      field.update_page(page, phi(physical));
    }
  });
  return known_ = std::move(field);
}

void ResidentPages::know(const SharedPages& pages) {
  known_.pages = pages;
  memory_.take_changes([](std::int64_t) {});
}

// Which of a page's voxels are inside the volume.
void ResidentPages::describe(PhysicalPage page) {
  PageInfo& info = fields_.info(page);
  info = PageInfo();
  const Index3 valid = memory_.layout().valid_shape(memory_.virtual_page(page));
  for (int axis = 0; axis < 3; ++axis) info.valid[axis] = static_cast<std::uint8_t>(valid[axis]);
  info.padding = padding_rows(info.valid[1], info.valid[2]);
  link_constraints(page);
}

void ResidentPages::link_constraints(PhysicalPage page) {
  const Constraints* constraints = contents_.constraints.get();
  fields_.info(page).constraints =
      constraints == nullptr ? nullptr : constraints->page(memory_.virtual_page(page));
}

void ResidentPages::link_constraints() {
  memory_.for_each_resident([&](PhysicalPage page) { link_constraints(page); });
}

// Tells the resident pages around `coordinates` which physical page is there now.
void ResidentPages::tell_neighbours(Index3 coordinates, PhysicalPage page) {
  for (int n = 0; n < kNeighbours; ++n) {
    const PhysicalPage other = memory_.physical(coordinates + neighbour_step(n));
    if (other >= kFirstPage) fields_.info(other).neighbours[opposite_neighbour(n)] = page;
  }
}

void ResidentPages::link_neighbours(PhysicalPage page) {
  const Index3 coordinates = memory_.layout().page_coordinates(memory_.virtual_page(page));
  for (int n = 0; n < kNeighbours; ++n) {
    fields_.info(page).neighbours[n] = memory_.physical(coordinates + neighbour_step(n));
  }
  tell_neighbours(coordinates, page);
}

std::uint8_t ResidentPages::requests(PhysicalPage page, int buffer) {
  PageInfo& info = fields_.info(page);
  const RowMasks& masks = fields_.masks(buffer, page);
  std::uint8_t code = 0;
  for (int face = 0; face < kFaces; ++face) {
    const PhysicalPage across = info.neighbours[face_neighbour(face)];
    if (is_static_page(across) && !face_is_constant(masks, face, across == kInsidePage)) {
      code |= request_bit(face);
    }
  }
  if (!masks.all_inside() && !masks.all_outside()) {
    info.constant_steps = 0;
  } else if (++info.constant_steps >= kConstantStepsBeforeRelease) {
    info.constant_steps = kConstantStepsBeforeRelease;
    code |= kReleaseBit;
  }
  return code;
}

Status ResidentPages::grant_requests(PhysicalPage page, std::uint8_t code) {
  const Index3 coordinates = memory_.layout().page_coordinates(memory_.virtual_page(page));
  for (int face = 0; face < kFaces; ++face) {
    if ((code & request_bit(face)) == 0) continue;
    const std::int64_t across = memory_.layout().page_number(coordinates + kFaceSteps[face]);
    if (!is_static_page(memory_.physical(across))) continue;  // asked for by another page, too
    if (auto made = make_resident(across); !made) {
      needs_activation_ = true;
      return pass_on(made);
    }
  }
  return {};
}

Status ResidentPages::activate_all() {
  std::vector<PhysicalPage> pages;
  memory_.for_each_resident([&](PhysicalPage page) { pages.push_back(page); });
  needs_activation_ = false;
  return activate(pages);
}

Status ResidentPages::activate_around(const std::vector<std::int64_t>& virtual_pages) {
  if (needs_activation_) return activate_all();
  std::vector<PhysicalPage> pages;
  for (const std::int64_t virtual_page : virtual_pages) {
    const Index3 coordinates = memory_.layout().page_coordinates(virtual_page);
    for (int n = 0; n < kNeighbours; ++n) {
      if (const PhysicalPage page = memory_.physical(coordinates + neighbour_step(n)); page >= kFirstPage)
        pages.push_back(page);
    }
  }
  std::sort(pages.begin(), pages.end());
  pages.erase(std::unique(pages.begin(), pages.end()), pages.end());
  return activate(pages);
}

Status ResidentPages::activate(const std::vector<PhysicalPage>& pages) {
  Status result;
  for (std::size_t i = 0; i < pages.size() && result; ++i) {
    result = grant_requests(pages[i], requests(pages[i], current_));
  }
  // Pages that are made resident on the way may ask for more.
  for (std::size_t i = 0; i < new_pages_.size() && result; ++i) {
    result = grant_requests(new_pages_[i], requests(new_pages_[i], current_));
  }
  fill_new_pages();
  return result;
}

Result<PhysicalPage> ResidentPages::make_resident(std::int64_t virtual_page) {
  const bool inside = memory_.physical(virtual_page) == kInsidePage;
  const Result<PhysicalPage> made = memory_.make_resident(virtual_page);
  TIDEMARK_TRY(made);
  const PhysicalPage page = *made;
  describe(page);
  RowMasks masks = RowMasks::constant(inside);
  masks.add_padding(fields_.info(page).padding);
  fields_.masks(0, page) = fields_.masks(1, page) = masks;
  link_neighbours(page);
  new_pages_.push_back(page);
  listed_.push_back(virtual_page);
  return page;
}

void ResidentPages::fill_new_pages() {
  threads_.for_each(static_cast<std::int64_t>(new_pages_.size()), 8,
                    [&](std::int64_t begin, std::int64_t end, int) {
                      for (std::int64_t i = begin; i < end; ++i) {
                        const PhysicalPage page = new_pages_[static_cast<std::size_t>(i)];
                        // A page without voxels that are W is all -W: constant pages have one kind of row.
                        const bool inside = fields_.masks(0, page).all_inside();
                        for (const int buffer : {0, 1}) {
                          std::fill_n(fields_.phi(buffer, page), kPageVoxels, constant(inside));
                        }
                        fill_motion(page);
                      }
                    });
  new_pages_.clear();
}

void ResidentPages::fill_motion(PhysicalPage page) {
  const std::int64_t virtual_page = memory_.virtual_page(page);
  const Index3 first = memory_.layout().first_voxel(virtual_page);
  const Index3 valid = memory_.layout().valid_shape(virtual_page);
  const auto constants = contents_.model.constants<double>();
  fill_data_motion(*contents_.speed, constants, first, valid, fields_.data_motion(page));
  if (float* advection = fields_.advection(page); advection != nullptr) {
    fill_advection(*contents_.speed, constants, first, valid, advection);
  }
}

Status ResidentPages::keep_advection(bool wanted) {
  if (wanted && !fields_.keeps_advection()) {
    TIDEMARK_TRY(memory_.check_budget(
        0, HostFields::kAdvectionFloatsPerPage * static_cast<std::int64_t>(sizeof(float))));
  }
  fields_.keep_advection(wanted);
  return {};
}

void ResidentPages::refill() {
  std::vector<PhysicalPage> pages;
  memory_.for_each_resident([&](PhysicalPage page) { pages.push_back(page); });
  threads_.for_each(static_cast<std::int64_t>(pages.size()), 8,
                    [&](std::int64_t begin, std::int64_t end, int) {
                      for (std::int64_t i = begin; i < end; ++i) {
                        fill_motion(pages[static_cast<std::size_t>(i)]);
                      }
                    });
}

// Whether everything that touches the faces of a constant page is the same constant.
bool ResidentPages::surroundings_are_constant(PhysicalPage page, bool inside) const {
  for (int face = 0; face < kFaces; ++face) {
    const PhysicalPage across = fields_.info(page).neighbours[face_neighbour(face)];
    if (across == kNoPage) continue;
    if (!face_is_constant(fields_.masks(current_, across), opposite_face(face), inside)) return false;
  }
  return true;
}

void ResidentPages::release_if_surrounded(PhysicalPage page) {
  const bool inside = fields_.masks(current_, page).all_inside();
  if (!surroundings_are_constant(page, inside)) return;
  const std::int64_t virtual_page = memory_.virtual_page(page);
  memory_.release(virtual_page, inside);
  tell_neighbours(memory_.layout().page_coordinates(virtual_page), inside ? kInsidePage : kOutsidePage);
}

void ResidentPages::set_static(Index3 coordinates, bool inside) {
  memory_.set_static(memory_.layout().page_number(coordinates), inside);
  tell_neighbours(coordinates, inside ? kInsidePage : kOutsidePage);
}

void ResidentPages::refresh(PhysicalPage page) {
  const PageInfo& info = fields_.info(page);
  fields_.masks(0, page) = fields_.masks(1, page) =
      masks_of(phi(page), info.valid[0], info.padding, constant(true));
  std::copy_n(phi(page), kPageVoxels, fields_.phi(1 - current_, page));
  note_change(page);
}

// Only the new ones are sorted.
void ResidentPages::put_in_order() {
  const auto first_new = listed_.begin() + listed_in_order_;
  if (first_new == listed_.end()) return;
  std::sort(first_new, listed_.end());
  std::inplace_merge(listed_.begin(), first_new, listed_.end());
  // A page that was freed and made resident again is there twice.
  listed_.erase(std::unique(listed_.begin(), listed_.end()), listed_.end());
}

std::int64_t ResidentPages::state_bytes() const {
  return memory_.field_bytes() - drive_bytes() + memory_.table_bytes() +
         static_cast<std::int64_t>(listed_.capacity() * sizeof(std::int64_t));
}

Status ResidentPages::validate() const {
  TIDEMARK_TRY(table().validate());
  Status result;
  memory_.for_each_resident([&](PhysicalPage page) {
    const Index3 coordinates = memory_.layout().page_coordinates(memory_.virtual_page(page));
    for (int n = 0; n < kNeighbours && result; ++n) {
      const PhysicalPage told = fields_.info(page).neighbours[n];
      const PhysicalPage there = memory_.physical(coordinates + neighbour_step(n));
      if (told == there) continue;
      result = fail(ErrorKind::internal, "page {}: neighbour {} is {} in the page, {} in the table", page, n,
                    told, there);
    }
  });
  return result;
}

Status ResidentPages::validate(const Field& copy) const {
  Status result;
  memory_.for_each_resident([&](PhysicalPage page) {
    const std::int64_t virtual_page = memory_.virtual_page(page);
    const float* copied = copy.pages.values(virtual_page);
    if (copied != nullptr && std::equal(copied, copied + kPageVoxels, phi(page))) return;
    result = fail(ErrorKind::internal, "the copy of phi does not hold what page {} holds", virtual_page);
  });
  return result;
}

}  // namespace tidemark::solver
