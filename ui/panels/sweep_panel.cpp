#include "ui/panels/sweep_panel.h"

#include <QCheckBox>
#include <QComboBox>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QVBoxLayout>
#include <cmath>

#include "engine/case_sweep.h"
#include "engine/message_text.h"
#include "ui/look/icons.h"
#include "ui/look/theme.h"
#include "ui/panels/sweep_axis_choice.h"
#include "ui/panels/sweep_matrix.h"
#include "ui/widgets/form.h"

namespace tidemark::ui {
namespace {

constexpr int kSweepBarSteps = 1000;  // of the progress bar

}  // namespace

SweepPanel::SweepPanel(QWidget* parent)
    : Panel(tr("Open a study to see what other parameters lead to."), parent) {
  add(make_axes());
  add(make_run());
  add(make_outcome());
  show_sweep();
}

QWidget* SweepPanel::make_axes() {
  auto* part = new QWidget;
  Form form(part);
  form.heading(tr("Runs from the start"));
  form.note(tr("One run to rest for each combination of values, in the background. The surface stays as it "
               "is until you click one."))
      ->setForegroundRole(QPalette::PlaceholderText);
  const auto add_axis = [&](const QString& name, bool optional) {
    auto* choice = new SweepAxisChoice(name, optional);
    form.wide(new QLabel(name));
    form.wide(choice);
    connect(choice, &SweepAxisChoice::parameter_chosen, this, [this, choice](const QString& parameter) {
      if (proxy() && !parameter.isEmpty()) choice->suggest(parameter.toStdString(), proxy()->parameters());
    });
    return choice;
  };
  across_ = add_axis(tr("Across"), false);
  down_ = add_axis(tr("Down"), true);
  return part;
}

QWidget* SweepPanel::make_run() {
  auto* part = new QWidget;
  Form form(part);
  run_ = new QPushButton;
  connect(run_, &QPushButton::clicked, this, &SweepPanel::start_or_cancel);
  form.wide(run_);
  progress_ = new QProgressBar;
  progress_->setTextVisible(false);
  progress_->setAccessibleName(tr("Progress"));
  progress_->setRange(0, kSweepBarSteps);
  form.wide(progress_);
  problem_ = form.note({});
  say({});
  return part;
}

QWidget* SweepPanel::make_outcome() {
  outcome_ = new QWidget;
  Form form(outcome_);
  colours_ = form.choice(tr("Colours"), tr("What the number below each picture, and its colour, tells."));
  colours_->addItem(tr("Volume"), static_cast<int>(SweepMatrix::Colours::volume));
  connect(colours_, &QComboBox::activated, this, [this] {
    matrix_->set_colours(static_cast<SweepMatrix::Colours>(colours_->currentData().toInt()));
  });
  agreement_ =
      form.check(tr("Agreement on the slices"),
                 tr("How many of the runs have a voxel inside, from one to all: what is certain, and "
                    "what depends on the parameters."));
  connect(agreement_, &QCheckBox::clicked, this, [this](bool on) {
    if (!sweep() || !sweep()->outcome()) return;
    proxy()->display().set_agreement(on ? std::optional(sweep()->outcome()->agreement) : std::nullopt);
  });
  spread_ = form.check(tr("Agreement on the surface"),
                       tr("In 3D, how far apart the surfaces of all runs lie: blue where they agree, orange "
                          "where the parameters decide."));
  connect(spread_, &QCheckBox::clicked, this, [this](bool on) {
    if (sweep() && sweep()->outcome()) proxy()->display().set_spread(on ? sweep()->agreement() : nullptr);
  });
  figures_ = form.note({});
  figures_->setMinimumHeight(2 * figures_->fontMetrics().lineSpacing());  // the matrix stays where it is
  matrix_ = new SweepMatrix;
  form.wide(matrix_);
  connect(matrix_, &SweepMatrix::looked_at, this, &SweepPanel::look_at);
  connect(matrix_, &SweepMatrix::wanted, this, [this](QPoint cell) {
    if (sweep()) sweep()->take(cell.x(), cell.y());
  });
  outcome_->hide();
  return outcome_;
}

engine::CaseSweep* SweepPanel::sweep() const {
  return proxy() ? &proxy()->sweep() : nullptr;
}

void SweepPanel::attach() {
  Panel::attach();
  if (shown_) {
    shown_->disconnect(this);
    axes_[*shown_] = {across_->axis(), down_->axis()};
  }
  shown_ = sweep();
  say({});
  if (shown_) {
    connect(shown_, &engine::CaseSweep::changed, this, &SweepPanel::show_sweep);
    connect(shown_, &engine::CaseSweep::failed, this, &SweepPanel::say);
    connect(shown_, &engine::CaseSweep::progressed, this, [this](double fraction, const QString&) {
      progress_->setValue(static_cast<int>(std::lround(fraction * kSweepBarSteps)));
    });
    show_axes();
  }
  show_sweep();
}

// As the user has left them, those of the case's last sweep, or some that suit its parameters.
void SweepPanel::show_axes() {
  for (SweepAxisChoice* choice : {across_, down_}) choice->set_setting(proxy()->drive().setting);
  if (const Axes* left = axes_.find(shown_)) {
    across_->show_axis(left->across);
    down_->show_axis(left->down);
    return;
  }
  if (const auto& outcome = sweep()->outcome()) {
    const auto& axes = outcome->sweep.axes;
    across_->show_axis(axes.front());
    down_->show_axis(axes.size() > 1 ? std::optional(axes.back()) : std::nullopt);
    return;
  }
  across_->suggest("alpha", proxy()->parameters());
  if (document::uses_tent(proxy()->drive())) {
    down_->suggest("range", proxy()->parameters());
  } else {
    down_->show_axis(std::nullopt);
  }
}

void SweepPanel::start_or_cancel() {
  if (!sweep()) return;
  if (sweep()->running()) return sweep()->cancel();
  std::vector<document::SweepAxis> axes;
  for (const SweepAxisChoice* choice : {across_, down_}) {
    if (const auto axis = choice->axis()) axes.push_back(*axis);
  }
  if (const Status good = document::check(axes, proxy()->parameters(), proxy()->drive().setting); !good)
    return say(engine::message_text(good.error()));
  say({});
  progress_->setValue(0);
  sweep()->start(axes);
}

void SweepPanel::say(const QString& problem) {
  problem_->setText(problem);
  problem_->setVisible(!problem.isEmpty());
}

void SweepPanel::show_sweep() {
  const bool running = sweep() && sweep()->running();
  run_->setText(running ? tr("Cancel") : tr("Run all"));
  run_->setIcon(icon(running ? u"close" : u"play"));
  run_->setToolTip(running ? tr("Gives the runs up; the last sweep stays.")
                           : tr("Computes all runs on all processors."));
  progress_->setVisible(running);
  const auto outcome = sweep() ? sweep()->outcome() : nullptr;
  matrix_->show_outcome(outcome);
  outcome_->setVisible(outcome != nullptr);
  if (!outcome) return;
  const int dice = colours_->findData(static_cast<int>(SweepMatrix::Colours::dice));
  const bool has_dice = outcome->sweep.runs.front().dice.has_value();
  if (has_dice && dice < 0) colours_->addItem(tr("Dice"), static_cast<int>(SweepMatrix::Colours::dice));
  if (!has_dice && dice >= 0) colours_->removeItem(dice);
  matrix_->set_colours(static_cast<SweepMatrix::Colours>(colours_->currentData().toInt()));
  look_at(matrix_->current());
  engine::Display& display = proxy()->display();
  if (display.agreement()) display.set_agreement(outcome->agreement);
  if (display.spread()) display.set_spread(sweep()->agreement());
  spread_->setEnabled(sweep()->agreement() != nullptr);
  show_taken();
}

void SweepPanel::show_taken() {
  const auto& outcome = sweep()->outcome();
  if (!outcome) return;
  const engine::CaseState& state = proxy()->state();
  std::optional<QPoint> taken;
  for (int row = 0; row < outcome->sweep.rows(); ++row) {
    for (int column = 0; column < outcome->sweep.columns(); ++column) {
      const document::SweepRun& run = outcome->sweep.at(column, row);
      const bool same_drive = run.drive == nullptr || run.drive->setting == state.drive.setting;
      if (run.parameters == state.parameters && run.steps == state.step && same_drive) taken = {column, row};
    }
  }
  matrix_->set_taken(taken);
}

void SweepPanel::look_at(QPoint cell) {
  figures_->setText(sweep_run_text(sweep()->outcome()->sweep, cell));
}

void SweepPanel::refresh() {
  for (SweepAxisChoice* choice : {across_, down_}) choice->set_setting(proxy()->drive().setting);
  run_->setEnabled(proxy()->state().begun || sweep()->running());
  agreement_->setChecked(proxy()->display().agreement().has_value());
  spread_->setChecked(proxy()->display().spread() != nullptr);
  show_taken();
}

}  // namespace tidemark::ui
