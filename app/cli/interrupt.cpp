#include "app/cli/interrupt.h"

#include <signal.h>

namespace tidemark::cli {
namespace {

// Wakes the waiting thread so that it sees that it is done.
constexpr int kWake = SIGUSR1;

sigset_t awaited_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  sigaddset(&signals, kWake);
  return signals;
}

}  // namespace

Interrupt::Interrupt() {
  ::signal(SIGXFSZ, SIG_IGN);
  ::signal(SIGPIPE, SIG_IGN);
  const sigset_t signals = awaited_signals();
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  waiter_ = std::thread([this, signals] {
    int received = 0;
    while (!done_ && sigwait(&signals, &received) == 0) {
      if (received != kWake) source_.request_stop();
    }
  });
}

Interrupt::~Interrupt() {
  done_ = true;
  pthread_kill(waiter_.native_handle(), kWake);
  waiter_.join();
}

}  // namespace tidemark::cli
