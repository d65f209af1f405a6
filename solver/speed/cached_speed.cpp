#include "solver/speed/cached_speed.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <new>

#include "core/index_walk.h"

namespace tidemark::solver {
namespace {

// Pages that one thread claims at once: a function that looks around its voxels reads less for all of them
// together.
constexpr std::int64_t kLongestRun = 8;

// Copies a part of the grid from one array to another.
void copy(const VoxelBox& part, const std::int16_t* from, const VoxelBox& from_box, std::int16_t* to,
          const VoxelBox& to_box) {
  for (std::int64_t z = 0; z < part.size.z; ++z) {
    for (std::int64_t y = 0; y < part.size.y; ++y) {
      const Index3 row = part.first + Index3(0, y, z);
      std::copy_n(from + number_in(from_box.size, row - from_box.first), part.size.x,
                  to + number_in(to_box.size, row - to_box.first));
    }
  }
}

void evaluate_anew(const SpeedFunction& function, const VoxelBox& box, std::int16_t* speed) {
  std::vector<double> values(static_cast<std::size_t>(box.voxels()));
  function.evaluate(box, values.data());
  std::transform(values.begin(), values.end(), speed, quantised_speed);
}

}  // namespace

struct CachedSpeed::Page {
  enum class State : std::uint8_t { claimed, evaluated, failed };

  std::array<std::int16_t, kPageVoxels> values;  // padding holds anything
  std::atomic<State> state{State::claimed};

  void set(State now) {
    state.store(now, std::memory_order_release);
    state.notify_all();
  }
};

std::int16_t quantised_speed(double speed) {
  return static_cast<std::int16_t>(std::lround(std::clamp(speed, -1.0, 1.0) * kSpeedSteps));
}

void evaluate_quantised(const SpeedFunction& function, const VoxelBox& box, std::int16_t* speed) {
  if (const auto* cached = dynamic_cast<const CachedSpeed*>(&function)) {
    cached->quantised(box, speed);
  } else {
    evaluate_anew(function, box, speed);
  }
}

CachedSpeed::CachedSpeed(std::shared_ptr<const SpeedFunction> function, Index3 grid_size)
    : function_(std::move(function)),
      layout_(grid_size, kDefaultPageShape),
      pages_(static_cast<std::size_t>(layout_.page_count())) {}

CachedSpeed::~CachedSpeed() {
  for (std::atomic<Page*>& page : pages_) delete page.load(std::memory_order_relaxed);
}

std::shared_ptr<const SpeedFunction> CachedSpeed::following(const Field& phi) const {
  auto next = function_->following(phi);
  if (next == nullptr) return nullptr;
  auto cached = std::make_shared<CachedSpeed>(next, layout_.domain_size());
  if (const auto* local = dynamic_cast<const LocallyFollowing*>(next.get())) cached->take_over(*this, *local);
  return cached;
}

void CachedSpeed::take_over(const CachedSpeed& former, const LocallyFollowing& function) {
  for (std::int64_t number = 0; number < layout_.page_count(); ++number) {
    const Index3 page = layout_.page_coordinates(number);
    const Page* there = former.ready(page);
    if (there == nullptr || !function.is_as_before(box_of(page)) || !claim(page)) continue;
    Page* own = entry(page).load(std::memory_order_relaxed);
    own->values = there->values;
    own->set(Page::State::evaluated);
  }
}

std::int64_t CachedSpeed::memory() const {
  return kept_pages_.load() * static_cast<std::int64_t>(sizeof(Page)) +
         static_cast<std::int64_t>(pages_.size() * sizeof(pages_.front()));
}

void CachedSpeed::evaluate(const VoxelBox& box, double* speed) const {
  std::vector<std::int16_t> values(static_cast<std::size_t>(box.voxels()));
  quantised(box, values.data());
  std::transform(values.begin(), values.end(), speed, speed_of);
}

void CachedSpeed::evaluate_once(const VoxelBox& box, double* speed) const {
  function_->evaluate_once(box, speed);
  std::transform(speed, speed + box.voxels(), speed, [](double d) { return speed_of(quantised_speed(d)); });
}

void CachedSpeed::quantised(const VoxelBox& box, std::int16_t* speed) const {
  if (is_mostly_missing(box)) return evaluate_anew(*function_, box, speed);
  const Index3 first = box.first / kDefaultPageShape;
  const Index3 last = (box.first + box.size - Index3(1)) / kDefaultPageShape;
  for (std::int64_t z = first.z; z <= last.z; ++z) {
    for (std::int64_t y = first.y; y <= last.y; ++y) {
      evaluate_what_is_missing(box, {first.x, y, z}, last.x + 1);
      answer(box, {first.x, y, z}, last.x + 1, speed);
    }
  }
}

VoxelBox CachedSpeed::box_of(Index3 page) const {
  const std::int64_t number = layout_.page_number(page);
  return {layout_.first_voxel(number), layout_.valid_shape(number)};
}

std::atomic<CachedSpeed::Page*>& CachedSpeed::entry(Index3 page) const {
  return pages_[static_cast<std::size_t>(layout_.page_number(page))];
}

const CachedSpeed::Page* CachedSpeed::ready(Index3 page) const {
  const Page* there = entry(page).load(std::memory_order_acquire);
  if (there == nullptr) return nullptr;
  return there->state.load(std::memory_order_acquire) == Page::State::evaluated ? there : nullptr;
}

const CachedSpeed::Page* CachedSpeed::waited_for(Index3 page) const {
  const Page* there = entry(page).load(std::memory_order_acquire);
  if (there != nullptr) there->state.wait(Page::State::claimed, std::memory_order_acquire);
  return ready(page);
}

bool CachedSpeed::claim(Index3 page) const {
  std::atomic<Page*>& place = entry(page);
  if (place.load(std::memory_order_acquire) != nullptr) return false;
  std::unique_ptr<Page> fresh(new (std::nothrow) Page());
  if (fresh == nullptr) return false;  // it is answered without being kept
  Page* nobody = nullptr;
  if (!place.compare_exchange_strong(nobody, fresh.get(), std::memory_order_acq_rel)) return false;
  static_cast<void>(fresh.release());  // the table owns it
  ++kept_pages_;
  return true;
}

bool CachedSpeed::takes_most(const VoxelBox& box, Index3 page) const {
  const VoxelBox whole = box_of(page);
  return 2 * common(box, whole).voxels() >= whole.voxels();
}

// One evaluation of a whole slice reads less than many of its parts.
bool CachedSpeed::is_mostly_missing(const VoxelBox& box) const {
  std::int64_t pages = 0;
  std::int64_t there = 0;
  const bool in_parts = all_pages(layout_, box.first, box.first + box.size, [&](Index3 page) {
    if (takes_most(box, page)) return false;
    ++pages;
    if (ready(page) != nullptr) ++there;
    return true;
  });
  return in_parts && 2 * there < pages;
}

void CachedSpeed::evaluate_pages(Index3 first, std::int64_t count) const {
  const VoxelBox last = box_of(first + Index3(count - 1, 0, 0));
  const VoxelBox start = box_of(first);
  const VoxelBox box{start.first, last.first + last.size - start.first};
  std::vector<std::int16_t> speed;
  const auto page = [&](std::int64_t i) {
    return entry(first + Index3(i, 0, 0)).load(std::memory_order_relaxed);
  };
  try {
    speed.resize(static_cast<std::size_t>(box.voxels()));
    evaluate_anew(*function_, box, speed.data());
  } catch (...) {  // for lack of memory: nobody must wait for these pages
    for (std::int64_t i = 0; i < count; ++i) page(i)->set(Page::State::failed);
    throw;
  }
  for (std::int64_t i = 0; i < count; ++i) {
    const VoxelBox part = box_of(first + Index3(i, 0, 0));
    copy(part, speed.data(), box, page(i)->values.data(), {part.first, kDefaultPageShape});
    page(i)->set(Page::State::evaluated);
  }
}

void CachedSpeed::evaluate_what_is_missing(const VoxelBox& box, Index3 first, std::int64_t end_x) const {
  Index3 page = first;
  while (page.x < end_x) {
    const Index3 start = page;
    while (page.x < end_x && page.x < start.x + kLongestRun && takes_most(box, page) && claim(page)) ++page.x;
    if (page.x > start.x) {
      evaluate_pages(start, page.x - start.x);
    } else {
      ++page.x;
    }
  }
}

void CachedSpeed::answer(const VoxelBox& box, Index3 first, std::int64_t end_x, std::int16_t* speed) const {
  for (Index3 page = first; page.x < end_x; ++page.x) {
    VoxelBox part = common(box, box_of(page));
    const Page* there = takes_most(box, page) ? waited_for(page) : ready(page);
    if (there != nullptr) {
      copy(part, there->values.data(), {box_of(page).first, kDefaultPageShape}, speed, box);
      continue;
    }
    while (page.x + 1 < end_x && !takes_most(box, page + Index3(1, 0, 0)) &&
           ready(page + Index3(1, 0, 0)) == nullptr) {
      ++page.x;
      const VoxelBox next = common(box, box_of(page));
      part.size.x = next.first.x + next.size.x - part.first.x;
    }
    std::vector<std::int16_t> values(static_cast<std::size_t>(part.voxels()));
    evaluate_anew(*function_, part, values.data());
    copy(part, values.data(), part, speed, box);
  }
}

}  // namespace tidemark::solver
