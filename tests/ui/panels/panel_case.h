// A case on a ball in a CT, for tests of panels.
#pragma once

#include <QTest>
#include <memory>

#include "engine/case_proxy.h"
#include "tests/engine/ball_study.h"
#include "tests/support/support.h"

namespace tidemark::test {

// Shows a widget and waits until it can be clicked.
void show(QWidget& widget);

// A widget by its accessible name; ends the test when there is none.
template <class Widget>
Widget* named(QWidget& in, const QString& name) {
  for (Widget* widget : in.findChildren<Widget*>()) {
    if (widget->accessibleName() == name) return widget;
  }
  qFatal("there is no %s", qPrintable(name));
}
// A button by its text.
template <class Button>
Button* button(QWidget& in, const QString& text) {
  for (Button* one : in.findChildren<Button*>()) {
    if (one->text() == text) return one;
  }
  qFatal("there is no button %s", qPrintable(text));
}

// Drags with the left button, in so many moves.
void drag(QWidget& widget, QPoint from, QPoint to, int moves = 5);

class PanelCase {
 public:
  explicit PanelCase(std::shared_ptr<const engine::LoadedStudy> study = ball_study());

  engine::Engine engine{false};
  std::unique_ptr<engine::CaseProxy> proxy;

  // Waits until all commands are done, and the proxy has the state. Not while it plays.
  void wait_until_idle();
  // A ball of that radius in the middle of the study.
  void begin(double radius_mm = 6.0);
  [[nodiscard]] const engine::CaseState& state() const { return proxy->state(); }
  [[nodiscard]] glm::dvec3 middle() const;
};

// A panel that shows the case, as wide as its column.
template <class AnyPanel>
std::unique_ptr<AnyPanel> shown(PanelCase& of, int height) {
  auto panel = std::make_unique<AnyPanel>();
  panel->set_proxy(of.proxy.get());
  panel->resize(300, height);
  show(*panel);
  return panel;
}

}  // namespace tidemark::test
