#include "app/cli/interrupt.h"

#include <fcntl.h>
#include <signal.h>
#include <time.h>
#include <unistd.h>

#include <cerrno>
#include <string_view>

#include "core/result.h"
#include "core/unfinished.h"

namespace tidemark::cli {
namespace {

// Wakes the waiting thread so that it sees that it is done.
constexpr int kWake = SIGUSR1;
// For the program to end by itself. With what it takes to clean up, a signal ends it within a second.
constexpr timespec kGrace{0, 700'000'000};
// For a last word that another thread has begun.
constexpr timespec kLastWord{0, 100'000'000};

bool is_ignored(int signal) {
  struct sigaction action {};
  return ::sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

// Not those that nohup ignores, or a script for its jobs in the background: they would arrive once blocked.
sigset_t awaited_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, kWake);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    if (!is_ignored(signal)) sigaddset(&signals, signal);
  }
  return signals;
}

}  // namespace

Interrupt::Interrupt() : standard_error_(::fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1)) {
  ::signal(SIGXFSZ, SIG_IGN);
  ::signal(SIGPIPE, SIG_IGN);
  const sigset_t signals = awaited_signals();
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  waiter_ = std::thread([this] { wait_for_signals(); });
}

void Interrupt::wait_for_signals() {
  const sigset_t signals = awaited_signals();
  int received = 0;
  do {
    if (sigwait(&signals, &received) != 0) return;
  } while (received == kWake && !done_);
  if (done_) return;
  source_.request_stop();
  // Impatient users send it again: it ends no sooner and no later.
  const sigset_t wake = [] {
    sigset_t only;
    sigemptyset(&only);
    sigaddset(&only, kWake);
    return only;
  }();
  while (!done_) {
    if (sigtimedwait(&wake, nullptr, &kGrace) < 0 && errno == EAGAIN) end_at_once();
  }
}

// Whoever holds locks of the C library, holds them still: nothing but system calls.
void Interrupt::end_at_once() {
  remove_unfinished();
  constexpr std::string_view kClear = "\r\x1b[K";  // the progress bar
  constexpr std::string_view kText = "tidemark-cli: error: interrupted\n";
  if (!take_last_word()) {
    ::nanosleep(&kLastWord, nullptr);
    ::_exit(exit_code(ErrorKind::cancelled));
  }
  if (::isatty(standard_error_) == 1)
    static_cast<void>(!::write(standard_error_, kClear.data(), kClear.size()));
  static_cast<void>(!::write(standard_error_, kText.data(), kText.size()));
  ::_exit(exit_code(ErrorKind::cancelled));
}

Interrupt::~Interrupt() {
  done_ = true;
  pthread_kill(waiter_.native_handle(), kWake);
  waiter_.join();
  ::close(standard_error_);
}

}  // namespace tidemark::cli
