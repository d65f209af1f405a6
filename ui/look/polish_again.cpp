#include "ui/look/polish_again.h"

#include <QApplication>
#include <QElapsedTimer>
#include <QPointer>
#include <QStyle>
#include <QWidget>
#include <algorithm>
#include <vector>

namespace tidemark::ui {
namespace {

constexpr qint64 kTurnMs = 20;

using Widgets = std::vector<QPointer<QWidget>>;

// Parents before their children, whose fonts are relative to theirs.
void add_with_children(QWidget& widget, Widgets& all) {
  all.emplace_back(&widget);
  for (QObject* child : widget.children()) {
    auto* inner = qobject_cast<QWidget*>(child);
    if (inner && !inner->isWindow()) add_with_children(*inner, all);
  }
}

// The application's only one.
class Polisher : public QObject {
 public:
  explicit Polisher(QObject* parent) : QObject(parent) {}

  void begin() {
    const bool under_way = !waiting_.empty();
    waiting_.clear();
    for (QWidget* window : QApplication::topLevelWidgets()) add_with_children(*window, waiting_);
    // What is seen lies in what is seen: parents stay before their children.
    std::stable_partition(waiting_.begin(), waiting_.end(), [](const auto& one) { return one->isVisible(); });
    std::reverse(waiting_.begin(), waiting_.end());
    if (!under_way) go_on();
  }

 private:
  void go_on() {
    QElapsedTimer turn;
    turn.start();
    while (!waiting_.empty() && !turn.hasExpired(kTurnMs)) {
      const QPointer<QWidget> next = waiting_.back();
      waiting_.pop_back();
      if (!next) continue;
      next->style()->polish(next);
      QEvent event(QEvent::StyleChange);
      QCoreApplication::sendEvent(next, &event);
    }
    if (!waiting_.empty())
      QMetaObject::invokeMethod(
          this, [this] { go_on(); }, Qt::QueuedConnection);
  }

  Widgets waiting_;  // the next is the last
};

}  // namespace

void polish_again() {
  auto* polisher = qApp->findChild<QObject*>(QStringLiteral("polisher"), Qt::FindDirectChildrenOnly);
  if (!polisher) {
    polisher = new Polisher(qApp);
    polisher->setObjectName(QStringLiteral("polisher"));
  }
  static_cast<Polisher*>(polisher)->begin();
}

}  // namespace tidemark::ui
