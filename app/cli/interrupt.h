// The stop request that Ctrl-C, termination and a closed terminal make, and soon the end.
#pragma once

#include <pthread.h>

#include <atomic>
#include <stop_token>
#include <thread>

namespace tidemark::cli {

// While it lives, a thread of its own waits for SIGINT, SIGTERM and SIGHUP, and then requests the stop;
// nothing runs inside a signal handler. A signal that was ignored before, as by nohup, stays ignored. A
// program that is in a library or waits for a file cannot stop by itself: the thread removes unfinished files
// and ends the process, with the exit code of an interrupt. Also ignores SIGXFSZ and SIGPIPE, so that a full
// disk and a closed pipe are failed writes rather than sudden death. Create it before any other thread.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  [[nodiscard]] std::stop_token stop_token() const { return source_.get_token(); }
  // Whether it is the caller who says why the program ends: the thread that ends it may have said so.
  [[nodiscard]] bool take_last_word() { return !said_.exchange(true); }

 private:
  void wait_for_signals();
  [[noreturn]] void end_at_once();

  const int standard_error_;  // also while commands have put it aside
  std::stop_source source_;
  std::atomic<bool> done_{false};
  std::atomic<bool> said_{false};
  std::thread waiter_;
};

}  // namespace tidemark::cli
