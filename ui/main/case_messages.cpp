#include "ui/main/case_messages.h"

#include "engine/case_autosave.h"
#include "engine/case_proxy.h"
#include "ui/main/case_window.h"
#include "ui/main/message_bar.h"

namespace tidemark {
namespace {

// One case's failure is not settled by another's success.
QString name_of(const CaseWindow& window) {
  return QStringLiteral("case %1").arg(reinterpret_cast<quintptr>(&window));
}

}  // namespace

CaseMessages::CaseMessages(CaseWindow& window, MessageBar& bar)
    : QObject(&window), window_(window), bar_(bar) {
  connect(&window.proxy(), &CaseProxy::failed, this, &CaseMessages::tell_failure);
  connect(&window.proxy(), &CaseProxy::state_changed, this, &CaseMessages::follow);
  connect(&window.autosave(), &CaseAutosave::failed, this, [this](const QString& message) {
    bar_.show_text(tr("Unsaved work cannot be copied against a crash: %1").arg(message));
  });
}

QString CaseMessages::done() const {
  const CaseState& state = window_.proxy().state();
  return QStringLiteral("%1 %2").arg(state.edits).arg(state.undo_text);
}

void CaseMessages::tell_failure(const QString& message) {
  done_at_failure_ = done();
  bar_.show_text(message, name_of(window_));
}

void CaseMessages::follow() {
  if (done() != done_at_failure_) bar_.settle(name_of(window_));
}

}  // namespace tidemark
