// A fixed team of threads for short, frequent parallel loops.
#pragma once

#include <atomic>
#include <cstdint>
#include <exception>
#include <functional>
#include <thread>
#include <vector>

namespace tidemark {

// A solver step takes some 100 microseconds, so waking a sleeping thread for each would cost as much as the
// work. Members therefore spin for a short while before they sleep, and a loop is one atomic counter. A loop
// never waits for a member that has not begun to help, so that on a busy machine, where the other threads get
// no processor, it is as fast as on one thread.
class ThreadPool {
 public:
  // threads >= 1 counts the caller, which works too; 0 means one per processor this process may use. Where
  // the system gives fewer, the team is smaller.
  explicit ThreadPool(int threads = 0);
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  [[nodiscard]] int threads() const { return static_cast<int>(workers_.size()) + 1; }

  // A member's contiguous share of a loop over [0, count): [begin, end).
  struct Range {
    std::int64_t begin = 0;
    std::int64_t end = 0;
  };
  [[nodiscard]] Range share(std::int64_t count, int member) const {
    return {count * member / threads(), count * (member + 1) / threads()};
  }

  // Calls body(begin, end, member) for pieces of [0, count) of at most `grain` until all are done, and
  // returns then. member is in [0, threads()). Each member begins with its own share, the same one every
  // time, so that what it touched in the last loop is still in its cache; then it helps the others.
  // Backward, a share's pieces come from its end: loops that change direction each time meet first what the
  // last one touched last. Not re-entrant: body must not call for_each of this pool, and only one thread at
  // a time may call it. The first exception of body leaves out pieces that are not begun yet, and is thrown
  // on to the caller when all members have ended.
  enum class Direction { forward, backward };
  using Body = std::function<void(std::int64_t begin, std::int64_t end, int member)>;
  void for_each(std::int64_t count, std::int64_t grain, const Body& body,
                Direction direction = Direction::forward);

 private:
  void work(int member);
  void run_pieces(int member);
  void take_pieces(int member);
  void throw_on();
  bool join_loop();
  void leave_loop();

  std::vector<std::jthread> workers_;
  std::atomic<std::uint32_t> generation_{0};  // a change starts a loop
  std::atomic<std::uint32_t> busy_{0};        // workers inside the loop, and kOpen while more may join
  std::atomic<bool> quit_{false};

  struct alignas(64) Share {  // a cache line each
    std::atomic<std::int64_t> taken{0};
    Range range;
  };
  std::vector<Share> shares_;  // one a member, at least
  std::int64_t grain_ = 1;
  Direction direction_ = Direction::forward;
  const Body* body_ = nullptr;
  std::atomic<bool> failed_{false};
  std::exception_ptr failure_;  // of whoever set failed_; read when all have ended
};

// The processors that this process may use (its affinity mask), at least 1.
int available_processors();

// Threads to read many small files with, at least 4: they wait for a disk, which may be far away, at the same
// time.
int reading_threads();

}  // namespace tidemark
