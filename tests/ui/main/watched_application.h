// The application of desktop tests, which notices what holds the thread of the user interface.
#pragma once

#include <QApplication>
#include <QStringList>
#include <utility>

namespace tidemark::test {

// Measures how long that thread computes in one event. Events within it belong to it, but those of a loop of
// its own are events for themselves: a question that it asks has one, which does what the user does. Time of
// the processor is counted and no time on the clock, so that it does not matter what else the machine does.
class WatchedApplication : public QApplication {
 public:
  // No event of a story may take more. Events are to take 50 ms at most; the rest is for slow machines.
  static constexpr double kLimitMs = TIDEMARK_EVENT_LIMIT_MS;

  WatchedApplication(int& argc, char** argv) : QApplication(argc, argv) {}
  bool notify(QObject* receiver, QEvent* event) override;

  void restart();  // of longest()
  [[nodiscard]] double longest_ms() const { return longest_ms_; }
  [[nodiscard]] QString longest() const;  // "31 ms in Paint of tidemark::VolumeViewWidget"
  // Those beyond the limit since the last call.
  [[nodiscard]] QStringList take_held() { return std::exchange(held_, {}); }
  // Where an event may take longer: a window is made, a picture grabbed.
  void forget_held() { held_.clear(); }
  // Stories that failed by such events.
  void note_failed_story() { ++failed_stories_; }
  [[nodiscard]] int failed_stories() const { return failed_stories_; }
  [[nodiscard]] static WatchedApplication& instance();

 private:
  void note_stretch();

  int loop_ = -1;          // the level of the loop whose event is measured; -1: none
  double since_ms_ = 0.0;  // the event began, or went on after its loop's last event
  QString in_now_;
  double longest_ms_ = 0.0;
  QString in_;
  QStringList held_;
  int failed_stories_ = 0;
};

}  // namespace tidemark::test
