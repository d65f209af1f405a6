// The heartbeat of the user interface's thread: the longest time without its events.
#pragma once

#include <QElapsedTimer>
#include <QTimer>
#include <algorithm>

namespace tidemark::test {

// A timer of 5 ms; the largest time between two of its ticks says for how long nothing else was done.
class Heartbeat {
 public:
  Heartbeat() {
    QObject::connect(&timer_, &QTimer::timeout, [this] { beat(); });
    timer_.setTimerType(Qt::PreciseTimer);
    timer_.start(5);
    since_.start();
  }
  [[nodiscard]] double largest_gap_ms() {
    beat();
    return largest_ms_;
  }

 private:
  void beat() {
    largest_ms_ = std::max(largest_ms_, static_cast<double>(since_.nsecsElapsed()) / 1e6);
    since_.restart();
  }

  QTimer timer_;
  QElapsedTimer since_;
  double largest_ms_ = 0.0;
};

}  // namespace tidemark::test
