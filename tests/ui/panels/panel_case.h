// A session on a ball in a CT, for tests of panels.
#pragma once

#include <QTest>
#include <memory>

#include "session/case_session.h"
#include "tests/session/ball_study.h"
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

class PanelCase {
 public:
  PanelCase();

  Engine engine{false};
  std::unique_ptr<CaseSession> session;

  // Waits until all that was asked for is done, and the session knows. Not while it plays.
  void settle();
  // A ball of that radius in the middle of the study.
  void begin(double radius_mm = 6.0);
  [[nodiscard]] const CaseState& state() const { return session->state(); }
  [[nodiscard]] glm::dvec3 middle() const;
};

// A panel that shows the case, as wide as its column.
template <class AnyPanel>
std::unique_ptr<AnyPanel> shown(PanelCase& of, int height) {
  auto panel = std::make_unique<AnyPanel>();
  panel->set_session(of.session.get());
  panel->resize(300, height);
  show(*panel);
  return panel;
}

}  // namespace tidemark::test
