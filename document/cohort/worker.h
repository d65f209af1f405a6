// A process for pieces of work, one after the other, with limits: whatever happens in it, its parent goes on.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <functional>
#include <string>

#include "core/result.h"

namespace tidemark::cohort {

// A piece of work, by what both sides know: no memory is shared after the fork.
struct WorkRequest {
  std::int64_t row = 0;     // of the work list
  std::int64_t number = 0;  // of the lease
  std::int64_t attempt = 0;
};

// The end of a piece of work.
struct WorkEnd {
  bool good = false;    // it has come to its end without an error
  Error error;          // else: its error, or "ended by signal 11 (Segmentation fault)"
  bool killed = false;  // by a signal that was not ours: the system's lack of memory does so, too
  std::int64_t peak_memory_bytes = 0;  // of a process that has ended
};

class Worker {
 public:
  // Forks. The copy holds what this process holds, so that no program is started and nothing is loaded, and
  // calls work() for each request. To be called where no other thread holds a lock that work() may want. The
  // memory that the copy may ask for is limited to so many bytes beyond what this process has; 0: it is not.
  // It ends with this process. Fails with ErrorKind::capability.
  static Result<Worker> start(const std::function<Status(const WorkRequest&)>& work,
                              std::int64_t memory_bytes);
  ~Worker();  // ends it
  Worker(Worker&& other) noexcept;
  Worker& operator=(Worker&& other) noexcept;

  // One at a time. Where the worker has ended, its answer says so.
  void send(const WorkRequest& request);
  // Readable when there is an answer, for poll().
  [[nodiscard]] int descriptor() const { return answers_; }
  // Waits for it.
  WorkEnd answer();
  void kill();
  // Memory that one piece of work has left in it is none of the next: after some pieces a new worker is
  // better.
  [[nodiscard]] bool is_fit() const { return process_ > 0 && !killed_ && served_ < kMostPieces; }

 private:
  static constexpr int kMostPieces = 64;

  Worker() = default;
  WorkEnd end();
  void close();

  pid_t process_ = -1;  // -1: moved from, or waited for
  int requests_ = -1;
  int answers_ = -1;
  int served_ = 0;
  bool killed_ = false;
};

}  // namespace tidemark::cohort
