#include "tests/ui/main/watched_application.h"

#include <QAbstractEventDispatcher>
#include <QMetaEnum>
#include <QThread>
#include <ctime>

namespace tidemark::test {
namespace {

constexpr double kWorthTellingMs = 30.0;

double processor_ms() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) / 1e6;
}

QString told(double ms, const QString& in) {
  return QStringLiteral("%1 ms in %2").arg(ms, 0, 'f', 0).arg(in);
}

}  // namespace

bool WatchedApplication::notify(QObject* receiver, QEvent* event) {
  // Events within events belong to the outermost one. Other threads have events of their own.
  if (depth_ > 0 || QThread::currentThread() != thread()) return QApplication::notify(receiver, event);
  in_now_ = QStringLiteral("%1 of %2")
                .arg(QMetaEnum::fromType<QEvent::Type>().valueToKey(event->type()),
                     receiver ? receiver->metaObject()->className() : "");
  since_ms_ = processor_ms();
  ++depth_;
  const bool handled = QApplication::notify(receiver, event);
  --depth_;
  note_stretch();
  return handled;
}

void WatchedApplication::watch_loops() {
  // A question that an event asks has a loop of its own, which does what the user does: what kept the user
  // waiting ends where it turns.
  auto* dispatcher = QAbstractEventDispatcher::instance();
  const auto turn = [this] {
    if (depth_ == 0) return;
    note_stretch();
    since_ms_ = processor_ms();
  };
  connect(dispatcher, &QAbstractEventDispatcher::aboutToBlock, this, turn);
  connect(dispatcher, &QAbstractEventDispatcher::awake, this, turn);
}

void WatchedApplication::note_stretch() {
  const double ms = processor_ms() - since_ms_;
  if (ms > kWorthTellingMs) qInfo("%s", qPrintable(told(ms, in_now_)));
  if (ms > kLimitMs) held_ << told(ms, in_now_);
  if (ms <= longest_ms_) return;
  longest_ms_ = ms;
  in_ = in_now_;
}

void WatchedApplication::restart() {
  longest_ms_ = 0.0;
  in_.clear();
}

QString WatchedApplication::longest() const {
  return told(longest_ms_, in_);
}

WatchedApplication& WatchedApplication::instance() {
  return static_cast<WatchedApplication&>(*qApp);
}

}  // namespace tidemark::test
