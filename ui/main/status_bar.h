// The status bar: values under the mouse, and who draws.
#pragma once

#include <QStatusBar>

#include "engine/case_proxy.h"

class QToolButton;

namespace tidemark::ui {

class ValueBar;

constexpr int kShownMs = 8000;  // a message about what was done

class StatusBar : public QStatusBar {
  Q_OBJECT
 public:
  explicit StatusBar(const engine::Engine& engine, QWidget* parent = nullptr);

  // Null: there is no case.
  void set_proxy(engine::CaseProxy* proxy);

 private:
  void note_renderer(const engine::Engine& engine);

  ValueBar* values_;
  QToolButton* value_details_;
};

}  // namespace tidemark::ui
