#include "core/thread_pool.h"

#include <sched.h>

#include <algorithm>
#include <utility>

namespace tidemark {
namespace {

// Some 100 microseconds of polling: longer than the serial part between two solver steps.
constexpr int kSpins = 4'000;

constexpr std::uint32_t kOpen = 0x8000'0000U;

inline void relax() {
#if defined(__x86_64__) || defined(__i386__)
  __builtin_ia32_pause();
#else
  std::this_thread::yield();
#endif
}

}  // namespace

int available_processors() {
  cpu_set_t set;
  if (sched_getaffinity(0, sizeof set, &set) == 0) return std::max(1, CPU_COUNT(&set));
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

int reading_threads() {
  return std::max(available_processors(), 4);
}

ThreadPool::ThreadPool(int threads) {
  const int members = threads > 0 ? threads : available_processors();
  shares_ = std::vector<Share>(static_cast<std::size_t>(members));
  workers_.reserve(shares_.size());
  try {
    for (int member = 1; member < members; ++member) {
      workers_.emplace_back([this, member] { work(member); });
    }
  } catch (const std::exception&) {
    // The system gives no more of them: those that there are do the work.
  }
}

ThreadPool::~ThreadPool() {
  quit_.store(true);
  generation_.fetch_add(1);
  generation_.notify_all();
}

void ThreadPool::run_pieces(int member) {
  try {
    take_pieces(member);
  } catch (...) {
    if (!failed_.exchange(true)) failure_ = std::current_exception();
  }
}

void ThreadPool::throw_on() {
  if (!failed_.load(std::memory_order_relaxed)) return;
  failed_.store(false, std::memory_order_relaxed);
  std::rethrow_exception(std::exchange(failure_, nullptr));
}

void ThreadPool::take_pieces(int member) {
  const auto members = static_cast<std::size_t>(threads());
  for (std::size_t i = 0; i < members; ++i) {
    Share& from = shares_[(static_cast<std::size_t>(member) + i) % members];
    for (;;) {
      const std::int64_t taken = from.taken.fetch_add(grain_, std::memory_order_relaxed);
      const std::int64_t left = from.range.end - from.range.begin - taken;
      if (left <= 0 || failed_.load(std::memory_order_relaxed)) break;
      const std::int64_t size = std::min(grain_, left);
      const std::int64_t begin =
          direction_ == Direction::forward ? from.range.begin + taken : from.range.begin + left - size;
      (*body_)(begin, begin + size, member);
    }
  }
}

bool ThreadPool::join_loop() {
  std::uint32_t busy = busy_.load(std::memory_order_relaxed);
  while ((busy & kOpen) != 0) {
    if (busy_.compare_exchange_weak(busy, busy + 1, std::memory_order_acquire)) return true;
  }
  return false;
}

void ThreadPool::leave_loop() {
  if (busy_.fetch_sub(1, std::memory_order_acq_rel) == 1) busy_.notify_one();
}

void ThreadPool::work(int member) {
  std::uint32_t seen = 0;
  for (;;) {
    for (int spin = 0; spin < kSpins && generation_.load(std::memory_order_acquire) == seen; ++spin) relax();
    generation_.wait(seen, std::memory_order_acquire);
    seen = generation_.load(std::memory_order_acquire);
    if (quit_.load()) return;
    if (!join_loop()) continue;
    run_pieces(member);
    leave_loop();
  }
}

void ThreadPool::for_each(std::int64_t count, std::int64_t grain, const Body& body, Direction direction) {
  if (count <= 0) return;
  grain_ = std::max<std::int64_t>(1, grain);
  direction_ = direction;
  body_ = &body;
  for (int member = 0; member < threads(); ++member) {
    Share& own = shares_[static_cast<std::size_t>(member)];
    own.taken.store(0, std::memory_order_relaxed);
    own.range = share(count, member);
  }
  // A loop of one piece is not worth waking anybody.
  if (workers_.empty() || count <= grain_) {
    run_pieces(0);
    return throw_on();
  }
  busy_.store(kOpen, std::memory_order_release);
  generation_.fetch_add(1, std::memory_order_release);
  generation_.notify_all();
  run_pieces(0);
  busy_.fetch_and(~kOpen, std::memory_order_acq_rel);
  for (int spin = 0; spin < kSpins; ++spin) {
    if (busy_.load(std::memory_order_acquire) == 0) return throw_on();
    relax();
  }
  for (std::uint32_t left = busy_.load(std::memory_order_acquire); left != 0;
       left = busy_.load(std::memory_order_acquire)) {
    busy_.wait(left, std::memory_order_acquire);
  }
  throw_on();
}

}  // namespace tidemark
