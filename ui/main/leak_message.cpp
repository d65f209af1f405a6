#include "ui/main/leak_message.h"

#include <cmath>

#include "engine/case_proxy.h"
#include "ui/main/case_window.h"
#include "ui/main/message_bar.h"
#include "ui/widgets/number_text.h"

namespace tidemark::ui {
namespace {

constexpr double kLessAlpha = 0.8;  // times what it was

}  // namespace

LeakMessage::LeakMessage(CaseWindow& window, MessageBar& bar) : QObject(&window), window_(window), bar_(bar) {
  connect(&window.proxy(), &engine::CaseProxy::state_changed, this, &LeakMessage::follow);
}

QString LeakMessage::about() const {
  return QStringLiteral("leak of case %1").arg(reinterpret_cast<quintptr>(&window_));
}

void LeakMessage::follow() {
  if (window_.proxy().state().leak == told_) return;
  told_ = window_.proxy().state().leak;
  if (told_) {
    show();
  } else {
    bar_.dismiss_about(about());
  }
}

void LeakMessage::show() {
  const document::Leak& leak = told_->leak;
  const glm::dvec3 place = window_.proxy().volume().geometry.to_patient(glm::dvec3(leak.middle));
  window_.proxy().display().change([&](engine::DisplaySettings& s) { s.cursor_mm = place; });
  const double alpha = std::round(100.0 * kLessAlpha * window_.proxy().parameters().alpha) / 100.0;
  bar_.show_offers(
      tr("Paused: the surface leaks. At the cross it came through a neck of %1 and has filled %2 behind it. "
         "Play "
         "goes on all the same.")
          .arg(number_text(leak.area_mm2, 0, tr("mm²")), number_text(leak.volume_ml, 2, tr("ml"))),
      about(),
      {{tr("Go back"), tr("To step %1, before the surface was in the neck.").arg(told_->before),
        [this] { go_back(); }},
       {tr("Wall it off"), tr("Goes back, puts a wall across the neck, and plays on."),
        [this] { wall_off(); }},
       {tr("α %1").arg(number_text(alpha, 2)),
        tr("Goes back, and plays on with a smaller α: a smoother surface passes no narrow neck."),
        [this, alpha] { lower_alpha(alpha); }}});
  bar_.mark_as_of(window_);
}

void LeakMessage::go_back() {
  window_.proxy().step_back(window_.proxy().state().step - told_->before);
}

void LeakMessage::wall_off() {
  const auto alarm = told_;
  go_back();
  window_.proxy().change_drive(
      [alarm, size = window_.proxy().volume().geometry.size](document::Drive& drive) {
        solver::Constraints walls = drive.constraints ? *drive.constraints : solver::Constraints(size);
        walls.set(alarm->leak.neck, solver::Constraint::wall);
        drive.constraints = std::make_shared<const solver::Constraints>(std::move(walls));
      });
  window_.proxy().play();
}

void LeakMessage::lower_alpha(double alpha) {
  go_back();
  window_.proxy().change_parameters([alpha](solver::Parameters& parameters) { parameters.alpha = alpha; });
  window_.proxy().play();
}

}  // namespace tidemark::ui
