// The status bar: values under the mouse, the progress of loading, and who draws.
#pragma once

#include <QStatusBar>

#include "engine/case_proxy.h"

class QToolButton;

namespace tidemark::ui {

class LoadingView;
class ValueBar;

constexpr int kShownMs = 8000;  // a message about what was done

class StatusBar : public QStatusBar {
  Q_OBJECT
 public:
  explicit StatusBar(const engine::Engine& engine, QWidget* parent = nullptr);

  // Null: there is no case.
  void set_proxy(engine::CaseProxy* proxy);
  [[nodiscard]] LoadingView& loading() { return *loading_; }

 private:
  void note_renderer(const engine::Engine& engine);

  ValueBar* values_;
  QToolButton* value_details_;
  LoadingView* loading_;
};

}  // namespace tidemark::ui
