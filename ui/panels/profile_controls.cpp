#include "ui/panels/profile_controls.h"

#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

#include "ui/look/theme.h"
#include "ui/panels/prediction_text.h"
#include "ui/panels/profile_plot.h"
#include "ui/panels/value_unit.h"
#include "ui/widgets/form.h"
#include "ui/widgets/into_sight.h"
#include "ui/widgets/number_text.h"

namespace tidemark::ui {
namespace {

constexpr int kPlaces = 257;  // along the line

}  // namespace

ProfileControls::ProfileControls(QWidget* parent) : CaseWidget(parent), content_(new QWidget) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(content_);
  content_->hide();
  Form form(content_);
  form.heading(tr("Along the line"));
  drawn_ = new QWidget;
  Form drawn(drawn_);
  plot_ = new ProfilePlot;
  plot_->setToolTip(
      tr("φ from the line's beginning to its end, positive and shaded inside of the surface; below it "
         "the brightness with T and the band T ± ε in which the data term grows the surface. "
         "Dotted: where φ = 0."));
  drawn.wide(plot_);
  crossings_ = drawn.figure(tr("φ = 0 at"), tr("From the line's beginning, which is the round end."));
  form.wide(drawn_);
  note_ = form.note(tr("Choose the tool Line profile and draw a line in a slice."));
  clear_ = new QPushButton(tr("Clear"));
  clear_->setToolTip(tr("Forget the line."));
  form.wide(clear_);
  connect(clear_, &QPushButton::clicked, this,
          [this] { change_display([](engine::DisplaySettings& settings) { settings.profile.reset(); }); });
}

// What is to be seen is known before its place is.
void ProfileControls::resizeEvent(QResizeEvent* event) {
  CaseWidget::resizeEvent(event);
  if (std::exchange(comes_to_sight_, false))
    QMetaObject::invokeMethod(
        this, [this] { bring_into_sight(*this); }, Qt::QueuedConnection);
}

void ProfileControls::refresh() {
  const engine::DisplaySettings& settings = proxy()->display().settings();
  const bool is_drawn = settings.profile && proxy()->state().begun && proxy()->state().phi;
  content_->setVisible(settings.profile || settings.tool == engine::Tool::profile);
  const bool was_drawn = drawn_->isVisibleTo(this);
  drawn_->setVisible(is_drawn);
  note_->setVisible(!is_drawn);
  note_->setText(settings.profile ? tr("Once there is a surface, φ along the line is plotted here.")
                                  : tr("Choose the tool Line profile and draw a line in a slice."));
  clear_->setVisible(settings.profile.has_value());
  if (is_drawn) show_line(*settings.profile);
  comes_to_sight_ = comes_to_sight_ || (is_drawn && !was_drawn);
}

void ProfileControls::show_line(const engine::Measurement& line) {
  const engine::CaseState& state = proxy()->state();
  const Volume& source = *proxy()->source();
  ProfilePlot::Content content;
  content.profile = solver::line_profile(*state.phi, source, line.points_mm[0], line.points_mm[1], kPlaces);
  content.length_mm = line.value();
  content.band = state.band;
  content.spacing_mm = smallest_spacing_mm(source.geometry);
  content.target = proxy()->parameters().target;
  content.range = document::uses_tent(state.drive) ? proxy()->parameters().range : 0.0;
  content.unit = value_unit(source);
  QStringList places;
  for (const double crossing : content.profile.crossings_mm) places << number_text(crossing, 1);
  crossings_->setText(places.isEmpty() ? QStringLiteral("–")
                                       : places.join(QStringLiteral("; ")) + QChar(QChar::Nbsp) + tr("mm"));
  plot_->set_content(std::move(content));
}

}  // namespace tidemark::ui
