#include "ui/panels/case_widget.h"

#include "ui/widgets/cancel_dialogs.h"

namespace tidemark::ui {

void CaseWidget::set_proxy(engine::CaseProxy* proxy) {
  if (proxy_ == proxy) return;
  cancel_dialogs(*this);
  if (proxy_) {
    proxy_->disconnect(this);
    proxy_->display().disconnect(this);
  }
  proxy_ = proxy;
  if (proxy) {
    connect(proxy, &engine::CaseProxy::state_changed, this, &CaseWidget::follow);
    connect(&proxy->display(), &engine::Display::changed, this, &CaseWidget::follow);
    connect(proxy, &QObject::destroyed, this, &CaseWidget::forget);
  }
  attach();
  follow();
}

void CaseWidget::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  if (proxy_) refresh();
}

void CaseWidget::follow() {
  if (proxy_ && isVisible()) refresh();
}

// The proxy is half destroyed: nothing of it may be used.
void CaseWidget::forget() {
  proxy_.clear();
  cancel_dialogs(*this);
  attach();
}

}  // namespace tidemark::ui
