#include "ui/panels/session_widget.h"

namespace tidemark {

void SessionWidget::set_session(CaseSession* session) {
  if (session_ == session) return;
  if (session_) {
    session_->disconnect(this);
    session_->display().disconnect(this);
  }
  session_ = session;
  if (session) {
    connect(session, &CaseSession::state_changed, this, &SessionWidget::follow);
    connect(&session->display(), &Display::changed, this, &SessionWidget::follow);
    connect(session, &QObject::destroyed, this, &SessionWidget::forget);
  }
  attach();
  follow();
}

void SessionWidget::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  if (session_) refresh();
}

void SessionWidget::follow() {
  if (session_ && isVisible()) refresh();
}

// The session is half gone: nothing of it may be used.
void SessionWidget::forget() {
  session_.clear();
  attach();
}

}  // namespace tidemark
