#include "ui/main/case_messages.h"

#include "engine/case_autosave.h"
#include "engine/case_proxy.h"
#include "ui/main/case_window.h"
#include "ui/main/message_bar.h"
#include "ui/widgets/number_text.h"

namespace tidemark::ui {
namespace {

// One case's failure is not settled by another's success.
QString name_of(const CaseWindow& window) {
  return QStringLiteral("case %1").arg(reinterpret_cast<quintptr>(&window));
}

QString outcome_name_of(const CaseWindow& window) {
  return QStringLiteral("surface of ") + name_of(window);
}

// `by_range`: T and epsilon drive the surface, beside other functions perhaps.
QString advice_on(document::Outcome outcome, bool by_range) {
  switch (outcome) {
    case document::Outcome::vanished:
      return by_range ? CaseMessages::tr(
                            "The surface has vanished: it has shrunk to nothing. Try a larger start, a wider "
                            "range "
                            "ε or a larger α, and restart.")
                      : CaseMessages::tr(
                            "The surface has vanished: it has shrunk to nothing. Try a larger start, a "
                            "larger α or "
                            "another speed function, and restart.");
    case document::Outcome::seeded_outside:
      return by_range
                 ? CaseMessages::tr(
                       "The surface has vanished: no value where it began is within T ± ε. Probe T and ε "
                       "over "
                       "the tissue, or draw another start, and restart.")
                 : CaseMessages::tr(
                       "The surface has vanished: the speed D is negative everywhere where it began. Look at "
                       "the speed map, draw another start, and restart.");
    case document::Outcome::filled_volume:
      return by_range
                 ? CaseMessages::tr(
                       "The surface has filled the volume: nothing has stopped it. Try a narrower range ε or "
                       "a smaller α, and restart.")
                 : CaseMessages::tr(
                       "The surface has filled the volume: nothing has stopped it. Try a smaller α, walls or "
                       "another speed function, and restart.");
    case document::Outcome::converged:
    case document::Outcome::unfinished:
      break;
  }
  return {};
}

}  // namespace

CaseMessages::CaseMessages(CaseWindow& window, MessageBar& bar)
    : QObject(&window), window_(window), bar_(bar) {
  connect(&window.proxy(), &engine::CaseProxy::failed, this, &CaseMessages::tell_failure);
  connect(&window.proxy(), &engine::CaseProxy::state_changed, this, &CaseMessages::follow);
  connect(&window.autosave(), &engine::CaseAutosave::failed, this, [this](const QString& message) {
    bar_.show_text(tr("Unsaved work cannot be copied against a crash: %1").arg(message));
    bar_.mark_as_of(window_);
  });
}

QString CaseMessages::done() const {
  const engine::CaseState& state = window_.proxy().state();
  return QStringLiteral("%1 %2").arg(state.edits).arg(state.undo_text);
}

void CaseMessages::tell_failure(const QString& message) {
  done_at_failure_ = done();
  bar_.show_text(message, name_of(window_));
  bar_.mark_as_of(window_);
}

void CaseMessages::follow() {
  if (done() != done_at_failure_) bar_.dismiss_about(name_of(window_));
  tell_outcome();
}

void CaseMessages::tell_outcome() {
  const engine::CaseState& state = window_.proxy().state();
  if (state.outcome == told_ && state.wider_range == offered_) return;
  told_ = state.outcome;
  offered_ = state.wider_range;
  const QString about = outcome_name_of(window_);
  if (const QString advice = advice_on(told_, document::uses_tent(state.drive)); !advice.isEmpty()) {
    bar_.show_text(advice, about);
    bar_.mark_as_of(window_);
  } else if (offered_) {
    bar_.show_offers(tr("The surface has stopped inside of like tissue: its values vary more than T ± %1.")
                         .arg(short_text(state.parameters.range)),
                     about,
                     {{tr("Widen the range to %1").arg(short_text(*offered_)), {}, [this, range = *offered_] {
                         widen(range);
                       }}});
    bar_.mark_as_of(window_);
  } else {
    bar_.dismiss_about(about);
  }
}

void CaseMessages::widen(double range) {
  window_.proxy().change_parameters([range](solver::Parameters& parameters) { parameters.range = range; });
  window_.proxy().play();
}

}  // namespace tidemark::ui
