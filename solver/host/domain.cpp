// The computational domain of the host executor: which pages are resident (NUMERICS rule: a page stays while
// it has a non-flat voxel, and the page across a face is needed as soon as the face differs from it).
#include <algorithm>

#include "solver/host/host_executor.h"
#include "solver/host/page_code.h"
#include "solver/paging/validate.h"

// After the standard headers: defines functions of these names.
#include "solver/speed/data-inl.h"

namespace tidemark {
namespace {

// Where a face's neighbour is among the 27.
constexpr int kFaceNeighbour[kFaces] = {12, 14, 10, 16, 4, 22};

constexpr int opposite_face(int face) {
  return face ^ 1;
}

Index3 neighbour_step(int neighbour) {
  return {neighbour % 3 - 1, neighbour / 3 % 3 - 1, neighbour / 9 - 1};
}

// How many steps in a row a page must be constant before it is freed: a front that hovers at its edge would
// otherwise allocate and free it all the time.
constexpr int kConstantStepsBeforeRelease = 2;

}  // namespace

// As many pages as the volume has or the budget allows.
PhysicalPage HostExecutor::pool_capacity() const {
  const std::int64_t page_bytes = PagePool::state_bytes(1) + PagePool::data_bytes(1);
  const std::int64_t affordable = options_.memory_budget_bytes / page_bytes + 1;
  return static_cast<PhysicalPage>(std::min(affordable, table_.layout().page_count()) + kFirstPage);
}

void HostExecutor::clear() {
  table_ = PageTable(PageLayout(source_->geometry.size, kDefaultPageShape));
  pool_ = PagePool(pool_capacity());
  for (const PhysicalPage page : {kOutsidePage, kInsidePage}) {
    const bool inside = page == kInsidePage;
    for (const int buffer : {0, 1}) {
      std::fill_n(pool_.phi(buffer, page), kPageVoxels, inside ? constants_.band : -constants_.band);
      pool_.masks(buffer, page) = RowMasks::constant(inside);
    }
  }
  current_ = 0;
  new_pages_.clear();
  listed_.clear();
  listed_in_order_ = 0;
  needs_activation_ = false;
  steps_in_window_ = 0;
  quiet_pages_ = 0;
  active_list_is_stale_ = true;
}

// Which of a page's voxels are inside the volume.
void HostExecutor::describe_page(PhysicalPage page) {
  PageInfo& info = pool_.info(page);
  info = PageInfo();
  const Index3 valid = table_.layout().valid_shape(table_.virtual_page(page));
  for (int axis = 0; axis < 3; ++axis) info.valid[axis] = static_cast<std::uint8_t>(valid[axis]);
  for (int row = 0; row < kPageRows; ++row) {
    if (row % kPageSide >= valid.y || row / kPageSide >= valid.z) info.padding |= Rows{1} << row;
  }
}

// Tells the resident pages around `coordinates` which physical page is there now.
void HostExecutor::tell_neighbours(Index3 coordinates, PhysicalPage page) {
  for (int n = 0; n < 27; ++n) {
    const PhysicalPage other = table_.physical(coordinates + neighbour_step(n));
    if (other >= kFirstPage) pool_.info(other).neighbours[26 - n] = page;
  }
}

void HostExecutor::link_neighbours(PhysicalPage page) {
  const Index3 coordinates = table_.layout().page_coordinates(table_.virtual_page(page));
  for (int n = 0; n < 27; ++n) {
    pool_.info(page).neighbours[n] = table_.physical(coordinates + neighbour_step(n));
  }
  tell_neighbours(coordinates, page);
}

// Makes the masks of both buffers those of the current one's values, and the other buffer equal to it.
void HostExecutor::refresh_masks(PhysicalPage page) {
  PageInfo& info = pool_.info(page);
  const float* phi = pool_.phi(current_, page);
  RowMasks masks;
  for (int row = 0; row < kPageRows; ++row) {
    const Rows bit = Rows{1} << row;
    const bool padding = (info.padding & bit) != 0;
    bool inside = true;
    bool outside = true;
    const int last = info.valid[0] - 1;
    const float* values = phi + row * kPageSide;
    for (int x = 0; x <= last; ++x) {
      inside = inside && values[x] == constants_.band;
      outside = outside && values[x] == -constants_.band;
    }
    // A padding voxel counts as both.
    const bool partial = info.valid[0] < kPageSide;
    if (padding || inside) masks.inside |= bit;
    if (padding || outside) masks.outside |= bit;
    if (padding || values[0] == constants_.band) masks.inside_first |= bit;
    if (padding || values[0] == -constants_.band) masks.outside_first |= bit;
    if (padding || partial || values[last] == constants_.band) masks.inside_last |= bit;
    if (padding || partial || values[last] == -constants_.band) masks.outside_last |= bit;
  }
  pool_.masks(0, page) = pool_.masks(1, page) = masks;
  std::copy_n(phi, kPageVoxels, pool_.phi(1 - current_, page));
}

// What a page asks for after a step, as one byte (paper section 4.4).
std::uint8_t HostExecutor::page_code(PhysicalPage page, int buffer) {
  PageInfo& info = pool_.info(page);
  const RowMasks& masks = pool_.masks(buffer, page);
  std::uint8_t code = 0;
  for (int face = 0; face < kFaces; ++face) {
    const PhysicalPage across = info.neighbours[kFaceNeighbour[face]];
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
  if (info.change > kQuietChange && !info.woke_neighbours) code |= kMovedBit;
  return code;
}

// Whether everything that touches the faces of a constant page is the same constant.
bool HostExecutor::surroundings_are_constant(PhysicalPage page, bool inside) const {
  for (int face = 0; face < kFaces; ++face) {
    const PhysicalPage across = pool_.info(page).neighbours[kFaceNeighbour[face]];
    if (across == kNoPage) continue;
    if (!face_is_constant(pool_.masks(current_, across), opposite_face(face), inside)) return false;
  }
  return true;
}

Status HostExecutor::check_budget(std::int64_t more_pages) const {
  const std::int64_t capacity =
      std::max<std::int64_t>(table_.capacity(), table_.capacity() + more_pages - table_.free_count());
  // The lists and tables that grow with the pages take at most this much more for each, their reserve
  // included.
  constexpr std::int64_t kListBytesPerPage = 64;
  const std::int64_t bytes = PagePool::state_bytes(capacity) + PagePool::data_bytes(capacity) +
                             table_.bytes() + capacity * kListBytesPerPage;
  if (bytes <= options_.memory_budget_bytes) return {};
  return fail(ErrorKind::capability, "the surface needs {} pages, {} MB, and the memory budget is {} MB",
              capacity, bytes >> 20, options_.memory_budget_bytes >> 20);
}

// Makes a page resident with the constant that stood for it. Its voxels are written by fill_new_pages().
Result<PhysicalPage> HostExecutor::make_resident(std::int64_t virtual_page) {
  if (table_.free_count() == 0) {
    TIDEMARK_TRY(check_budget(1));
  }
  const bool inside = table_.physical(virtual_page) == kInsidePage;
  const PhysicalPage page = table_.allocate(virtual_page);
  describe_page(page);
  RowMasks masks = RowMasks::constant(inside);
  masks.add_padding(pool_.info(page).padding);
  pool_.masks(0, page) = pool_.masks(1, page) = masks;
  link_neighbours(page);
  new_pages_.push_back(page);
  listed_.push_back(virtual_page);
  peak_resident_ = std::max(peak_resident_, table_.resident());
  active_list_is_stale_ = true;
  return page;
}

Status HostExecutor::make_neighbours_resident(PhysicalPage page, std::uint8_t code) {
  const Index3 coordinates = table_.layout().page_coordinates(table_.virtual_page(page));
  for (int face = 0; face < kFaces; ++face) {
    if ((code & request_bit(face)) == 0) continue;
    const std::int64_t across =
        table_.layout().page_number(coordinates + neighbour_step(kFaceNeighbour[face]));
    if (!is_static_page(table_.physical(across))) continue;  // asked for by another page, too
    TIDEMARK_TRY(make_resident(across));
  }
  return {};
}

void HostExecutor::fill_new_pages() {
  threads_->for_each(
      static_cast<std::int64_t>(new_pages_.size()), 8, [&](std::int64_t begin, std::int64_t end, int) {
        for (std::int64_t i = begin; i < end; ++i) {
          const PhysicalPage page = new_pages_[static_cast<std::size_t>(i)];
          // A page without voxels that are W is all -W: constant pages have one kind of row.
          const bool inside = pool_.masks(0, page).all_inside();
          for (const int buffer : {0, 1}) {
            std::fill_n(pool_.phi(buffer, page), kPageVoxels, inside ? constants_.band : -constants_.band);
          }
          fill_data_motion(page);
        }
      });
  new_pages_.clear();
}

// How far the data term moves the surface in a step at each voxel of a page; 0 at padding.
void HostExecutor::fill_data_motion(PhysicalPage page) {
  const std::int64_t virtual_page = table_.virtual_page(page);
  const Index3 first = table_.layout().first_voxel(virtual_page);
  const Index3 valid = table_.layout().valid_shape(virtual_page);
  const auto constants = model_.constants<double>();
  float* motion = pool_.data_motion(page);
  std::fill_n(motion, kPageVoxels, 0.0F);
  std::visit(
      [&](const auto& stored) {
        for (std::int64_t z = 0; z < valid.z; ++z) {
          for (std::int64_t y = 0; y < valid.y; ++y) {
            const auto* row = stored.data() + source_->geometry.offset(first + Index3(0, y, z));
            float* to = motion + (y + kPageSide * z) * kPageSide;
            for (std::int64_t x = 0; x < valid.x; ++x) {
              const double value = source_->slope * static_cast<double>(row[x]) + source_->intercept;
              to[x] = static_cast<float>(HWY_NAMESPACE::data_motion(value, constants));
            }
          }
        }
      },
      source_->voxels);
}

// The same for every resident page, after the parameters changed.
void HostExecutor::refill_data_motion() {
  std::vector<PhysicalPage> pages;
  for_each_resident([&](PhysicalPage page) { pages.push_back(page); });
  threads_->for_each(static_cast<std::int64_t>(pages.size()), 8,
                     [&](std::int64_t begin, std::int64_t end, int) {
                       for (std::int64_t i = begin; i < end; ++i) {
                         fill_data_motion(pages[static_cast<std::size_t>(i)]);
                       }
                     });
}

void HostExecutor::release_page(PhysicalPage page) {
  const std::int64_t virtual_page = table_.virtual_page(page);
  const bool inside = pool_.masks(current_, page).all_inside();
  table_.release(virtual_page, inside);
  tell_neighbours(table_.layout().page_coordinates(virtual_page), inside ? kInsidePage : kOutsidePage);
  active_list_is_stale_ = true;
}

// Maintenance after a step: grants the requests, frees pages that have become constant, wakes neighbours of
// pages that move. Fails when the budget does not allow a page; what could be done is done then.
Status HostExecutor::update_domain() {
  Status result;
  for (std::size_t i = 0; i < active_.size(); ++i) {
    const std::uint8_t code = codes_[i];
    if (code == 0) continue;
    const PhysicalPage page = active_[i];
    if ((code & kRequestBits) != 0 && result) {
      result = make_neighbours_resident(page, code);
      needs_activation_ = !result;
    }
    if ((code & kMovedBit) != 0) wake_around(page);
    if ((code & kReleaseBit) != 0) {
      if (surroundings_are_constant(page, pool_.masks(current_, page).all_inside())) release_page(page);
    }
  }
  fill_new_pages();
  return result;
}

// Grants the requests of every resident page, after phi was replaced or painted.
Status HostExecutor::activate_all() {
  Status result;
  // Pages that are made resident on the way may ask for more.
  for (PhysicalPage page = kFirstPage; page < table_.capacity() && result; ++page) {
    if (table_.virtual_page(page) < 0) continue;
    result = make_neighbours_resident(page, page_code(page, current_));
  }
  for (std::size_t i = 0; i < new_pages_.size() && result; ++i) {
    result = make_neighbours_resident(new_pages_[i], page_code(new_pages_[i], current_));
  }
  fill_new_pages();
  needs_activation_ = !result;
  return result;
}

Status HostExecutor::validate() const {
  TIDEMARK_TRY(table_.validate());
  Status result;
  std::int64_t asleep = 0;
  for_each_resident([&](PhysicalPage page) {
    const PageInfo& info = pool_.info(page);
    if (info.asleep) ++asleep;
    const Index3 coordinates = table_.layout().page_coordinates(table_.virtual_page(page));
    for (int n = 0; n < 27 && result; ++n) {
      if (info.neighbours[n] != table_.physical(coordinates + neighbour_step(n))) {
        result = fail(ErrorKind::internal, "page {}: neighbour {} is {} in the page, {} in the table", page,
                      n, info.neighbours[n], table_.physical(coordinates + neighbour_step(n)));
      }
    }
    if (result && info.asleep &&
        !std::equal(pool_.phi(0, page), pool_.phi(0, page) + kPageVoxels, pool_.phi(1, page))) {
      result = fail(ErrorKind::internal, "page {} is quiet, but its two buffers differ", page);
    }
  });
  if (!result) return result;
  if (asleep != quiet_pages_) {
    return fail(ErrorKind::internal, "{} pages are quiet, and {} are counted", asleep, quiet_pages_);
  }
  if (!active_list_is_stale_) {
    if (std::ssize(active_) != table_.resident() - asleep) {
      return fail(ErrorKind::internal, "{} pages are active, and {} are listed", table_.resident() - asleep,
                  active_.size());
    }
    std::int64_t before = -1;
    for (const PhysicalPage page : active_) {
      if (table_.virtual_page(page) <= before || pool_.info(page).asleep) {
        return fail(ErrorKind::internal, "page {} is not in its place in the list of active pages", page);
      }
      before = table_.virtual_page(page);
    }
  }
  return tidemark::validate(*snapshot());
}

}  // namespace tidemark
