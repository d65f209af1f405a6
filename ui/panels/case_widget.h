// The common base of all parts of the panels: they show one case, the active one.
#pragma once

#include <QPointer>
#include <QWidget>
#include <utility>

#include "engine/case_proxy.h"

namespace tidemark::ui {

class CaseWidget : public QWidget {
  Q_OBJECT
 public:
  explicit CaseWidget(QWidget* parent = nullptr) : QWidget(parent) {}

  // Null: no case is open. A proxy that is destroyed is forgotten. Dialogs of the parts ask about one case:
  // they are cancelled when there is another.
  void set_proxy(engine::CaseProxy* proxy);
  [[nodiscard]] engine::CaseProxy* proxy() const { return proxy_; }

 protected:
  // Another case, or none any more; refresh() follows.
  virtual void attach() {}
  // The case has changed. Called only with a case; a hidden widget is refreshed when it is shown again.
  virtual void refresh() = 0;
  void showEvent(QShowEvent* event) override;

  // change_display([&](DisplaySettings& settings) { settings.window = window; });
  template <class Change>
  void change_display(Change&& apply) {
    if (proxy_) proxy_->display().change(std::forward<Change>(apply));
  }

 private:
  void follow();
  void forget();
  QPointer<engine::CaseProxy> proxy_;
};

}  // namespace tidemark::ui
