#include "ui/panels/evolution_figures.h"

#include <QCheckBox>
#include <QLabel>

#include "engine/truth_comparison.h"
#include "ui/widgets/disclosure.h"
#include "ui/widgets/form.h"
#include "ui/widgets/number_text.h"

namespace tidemark::ui {
namespace {

// Nothing is known of a surface that has not been watched for a while.
QString moving_text(const engine::CaseState& state) {
  if (!state.begun || !document::has_surface(state.outcome)) return kNothing;
  if (state.converged) return EvolutionFigures::tr("nowhere");
  if (!state.moving_pages || state.moving_pages->empty()) return kNothing;
  return EvolutionFigures::tr("%1 of %2 pages")
      .arg(count_text(static_cast<std::int64_t>(state.moving_pages->size())),
           count_text(state.memory.resident_pages));
}

}  // namespace

EvolutionFigures::EvolutionFigures(QWidget* parent) : CaseWidget(parent) {
  Form form(this);
  form.heading(tr("Figures"));
  step_ = form.figure(tr("Step"), tr("Steps since the surface was placed."));
  dice_part_ = new QWidget;
  Form truth(dice_part_);
  dice_ = truth.figure(tr("Dice"), tr("How well the surface agrees with the true shape: 1 is all of "
                                      "it and nothing else, 0 nothing of it."));
  truth_ =
      truth.check(tr("Show the truth"), tr("Draws the outline of the true shape into slices, in violet."));
  connect(truth_, &QCheckBox::clicked, this, [this](bool on) {
    change_display([=](engine::DisplaySettings& settings) { settings.truth = on; });
  });
  mean_distance_ = truth.figure(tr("Mean distance"), tr("Between the surface and the true one, both ways, on "
                                                        "average. As often as a tenth of the time allows."));
  most_distance_ = truth.figure(tr("Hausdorff 95"),
                                tr("95 of 100 places of the two surfaces are no farther from the other "
                                   "one (the 95th percentile of the distances of both ways)."));
  truth_error_ =
      truth.check(tr("Distances to the truth"),
                  tr("Orange: what the surface has too much. Blue and hatched: what it has too little. "
                     "The stronger, the farther; the dark line is the true outline. In 3D the "
                     "surface has these colours."));
  connect(truth_error_, &QCheckBox::clicked, this, [this](bool on) {
    change_display([=](engine::DisplaySettings& settings) { settings.truth_error = on; });
  });
  dice_part_->hide();  // until there is a truth
  form.wide(dice_part_);
  comparison_ = new engine::TruthComparison(this);
  connect(comparison_, &engine::TruthComparison::answered, this, &EvolutionFigures::show_distances);
  auto* fold = new Disclosure(tr("Details of the figures"), QStringLiteral("figures"));
  form.wide(fold);
  Form details(fold->content());
  add_details(details);
}

void EvolutionFigures::add_details(Form& form) {
  pace_ = form.figure(tr("Steps per second"), tr("While it plays: with the time for pictures. Else: in the "
                                                 "solver's own time."));
  pages_ = form.figure(tr("Resident pages"), tr("Pages of the level set that are in memory, those near the "
                                                "surface; and how many of them rest."));
  moves_ = form.figure(tr("Still moving"),
                       tr("Pages in which the surface goes on, inwards or outwards; voxels that only flicker "
                          "do not count. F goes to the place that moves most."));
  bytes_ = form.figure(tr("Memory"), tr("What the level set takes, without the source."));
}

void EvolutionFigures::attach() {
  comparison_->forget();
  show_distances();
  if (proxy()) return;
  dice_part_->hide();
  for (QLabel* figure : {step_, moves_, dice_, pages_, bytes_, pace_}) figure->clear();
}

void EvolutionFigures::show_distances() {
  const auto distance = comparison_->distance();
  const auto text = [](double mm) { return number_text(mm, 2) + QChar(QChar::Nbsp) + tr("mm"); };
  mean_distance_->setText(distance ? text(distance->mean_mm) : kNothing);
  most_distance_->setText(distance ? text(distance->most_mm) : kNothing);
}

void EvolutionFigures::refresh() {
  const engine::CaseState& state = proxy()->state();
  step_->setText(count_text(state.step));
  moves_->setText(moving_text(state));
  dice_->setText(state.begun && state.dice ? number_text(*state.dice, 3) : kNothing);
  const auto& truth = proxy()->truth();
  dice_part_->setVisible(truth != nullptr);
  if (truth && state.begun && state.phi) {
    comparison_->ask(truth, state.phi);
  } else {
    comparison_->forget();
  }
  show_distances();
  truth_->setChecked(proxy()->display().settings().truth);
  truth_error_->setChecked(proxy()->display().settings().truth_error);
  const double measured = state.playing ? state.steps_per_second : state.solver_steps_per_second;
  const double pace = document::has_surface(state.outcome) ? measured : 0.0;
  pace_->setText(pace > 0.0 ? short_text(pace) : kNothing);
  pages_->setText(tr("%1, %2 at rest")
                      .arg(count_text(state.memory.resident_pages), count_text(state.memory.quiet_pages)));
  bytes_->setText(number_locale().formattedDataSize(state.memory.state_bytes, 1, QLocale::DataSizeSIFormat));
}

}  // namespace tidemark::ui
