#include "tests/ui/main/watched_application.h"

#include <QMetaEnum>
#include <QScopedValueRollback>
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
  // Other threads have events of their own.
  if (QThread::currentThread() != thread() || thread()->loopLevel() <= loop_) {
    return QApplication::notify(receiver, event);
  }
  if (loop_ >= 0) note_stretch();
  const QScopedValueRollback loop(loop_, thread()->loopLevel());
  const QScopedValueRollback in_now(in_now_,
                                    QStringLiteral("%1 of %2")
                                        .arg(QMetaEnum::fromType<QEvent::Type>().valueToKey(event->type()),
                                             receiver ? receiver->metaObject()->className() : ""));
  since_ms_ = processor_ms();
  const bool handled = QApplication::notify(receiver, event);
  note_stretch();
  since_ms_ = processor_ms();
  return handled;
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
