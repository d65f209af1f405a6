// The heartbeat of the user interface's thread: the longest time without its events, and how busy it was.
#pragma once

#include <QElapsedTimer>
#include <QTimer>
#include <algorithm>
#include <ctime>

namespace tidemark::test {

// A timer of 5 ms; the largest time between two of its ticks says for how long nothing else was done.
class Heartbeat {
 public:
  Heartbeat() {
    QObject::connect(&timer_, &QTimer::timeout, [this] { beat(); });
    timer_.setTimerType(Qt::PreciseTimer);
    timer_.start(5);
    since_.start();
    begin_.start();
  }
  [[nodiscard]] double largest_gap_ms() {
    beat();
    return largest_ms_;
  }
  // The share of the time since its beginning in which the thread has computed. What else the machine does
  // makes it smaller.
  [[nodiscard]] double busy_share() const {
    return (processor_ms() - before_ms_) * 1e6 / static_cast<double>(begin_.nsecsElapsed());
  }

 private:
  static double processor_ms() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) / 1e6;
  }
  void beat() {
    largest_ms_ = std::max(largest_ms_, static_cast<double>(since_.nsecsElapsed()) / 1e6);
    since_.restart();
  }

  QTimer timer_;
  QElapsedTimer since_;
  QElapsedTimer begin_;
  double before_ms_ = processor_ms();
  double largest_ms_ = 0.0;
};

}  // namespace tidemark::test
