// The stop request that Ctrl-C and termination make.
#pragma once

#include <pthread.h>

#include <atomic>
#include <stop_token>
#include <thread>

namespace tidemark::cli {

// While it lives, SIGINT and SIGTERM are waited for by a thread of its own, which asks everybody to stop;
// nothing runs inside a signal handler. Also ignores SIGXFSZ and SIGPIPE, so that a full disk and a closed
// pipe are failed writes rather than sudden death. Create it before any other thread.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  [[nodiscard]] std::stop_token stop_token() const { return source_.get_token(); }

 private:
  std::stop_source source_;
  std::atomic<bool> done_{false};
  std::thread waiter_;
};

}  // namespace tidemark::cli
