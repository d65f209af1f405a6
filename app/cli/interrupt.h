// Ctrl-C, termination and a closed terminal as a request to stop, and soon as an end.
#pragma once

#include <pthread.h>

#include <atomic>
#include <stop_token>
#include <thread>

namespace tidemark::cli {

// While it lives, SIGINT, SIGTERM and SIGHUP are waited for by a thread of its own, which asks everybody to
// stop; nothing runs inside a signal handler. Where the program is in a library that cannot be asked, or
// waits for a file, the thread removes what is unfinished and ends the process, with the exit code of an
// interrupt. Also ignores SIGXFSZ and SIGPIPE, so that a full disk and a closed pipe are failed writes rather
// than sudden death. Create it before any other thread.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  [[nodiscard]] std::stop_token stop_token() const { return source_.get_token(); }

 private:
  void wait_for_signals();

  std::stop_source source_;
  std::atomic<bool> done_{false};
  std::thread waiter_;
};

}  // namespace tidemark::cli
