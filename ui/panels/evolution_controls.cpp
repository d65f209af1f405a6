#include "ui/panels/evolution_controls.h"

#include <QAction>
#include <QCheckBox>
#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QStandardItemModel>
#include <QToolButton>

#include "engine/message_text.h"
#include "ui/look/theme.h"
#include "ui/widgets/disclosure.h"
#include "ui/widgets/form.h"
#include "ui/widgets/slider_number.h"

namespace tidemark::ui {
namespace {

constexpr double kFreePace = 1000.0;  // steps a second: more are not told apart
constexpr double kLeastNarrowing = 1.5;
constexpr double kMostNarrowing = 10.0;
constexpr std::int64_t kStepsPerPicture[] = {0, 1, 2, 5, 10, 50, 100};

struct ExecutorChoice {
  solver::ExecutorKind kind;
  const char* name;  // Executor::name()
};
constexpr ExecutorChoice kChoices[] = {{solver::ExecutorKind::automatic, "automatic"},
                                       {solver::ExecutorKind::host, "host"},
                                       {solver::ExecutorKind::compute, "compute"},
                                       {solver::ExecutorKind::stream, "stream"}};

// Why this machine cannot run it; empty when it can.
QString obstacle(solver::ExecutorKind kind, const engine::Engine& engine) {
  if (kind == solver::ExecutorKind::automatic || kind == solver::ExecutorKind::host) return {};
  if (engine.graphics() == engine::Engine::Graphics::none) {
    return EvolutionControls::tr("There is no OpenGL: %1")
        .arg(engine::message_text(engine.graphics_problem()));
  }
  if (kind == solver::ExecutorKind::compute && !engine.capabilities().at_least(4, 5)) {
    return EvolutionControls::tr("Needs OpenGL 4.5; this machine has %1.%2")
        .arg(engine.capabilities().major)
        .arg(engine.capabilities().minor);
  }
  return {};
}

QString outcome_word(document::Outcome outcome) {
  switch (outcome) {
    case document::Outcome::converged:
      return EvolutionControls::tr("converged");
    case document::Outcome::vanished:
    case document::Outcome::seeded_outside:
      return EvolutionControls::tr("vanished");
    case document::Outcome::filled_volume:
      return EvolutionControls::tr("volume filled");
    case document::Outcome::unfinished:
      break;
  }
  return EvolutionControls::tr("paused");
}

QString title(solver::ExecutorKind kind) {
  switch (kind) {
    case solver::ExecutorKind::host:
      return EvolutionControls::tr("Host: the processor");
    case solver::ExecutorKind::compute:
      return EvolutionControls::tr("Compute: the GPU");
    case solver::ExecutorKind::stream:
      return EvolutionControls::tr("Stream: the paper's way");
    default:
      return EvolutionControls::tr("Automatic");
  }
}

}  // namespace

EvolutionControls::EvolutionControls(QWidget* parent) : CaseWidget(parent) {
  Form form(this);
  form.heading(tr("Evolution"));
  form.wide(make_buttons());
  pace_ = form.slider(tr("Steps/s"),
                      tr("How many steps are played in a second, at most. At the right end: as many "
                         "as the computer can."));
  pace_->set_decimals(0);
  pace_->set_range(1.0, kFreePace, SliderNumber::Scale::logarithmic);
  form.ends_of(*pace_, tr("slow"), tr("free"));
  connect(pace_, &SliderNumber::edited, this, [this](double pace) {
    if (proxy()) proxy()->set_pace(pace < kFreePace ? pace : 0.0);
  });
  pause_ = form.check(tr("Pause at convergence"), tr("Pauses as soon as the surface has stopped moving."));
  connect(pause_, &QCheckBox::clicked, this, [this](bool on) {
    if (proxy()) proxy()->set_pause_at_convergence(on);
  });
  leaks_ =
      form.check(tr("Pause at a leak"),
                 tr("Pauses when the surface comes through a narrow neck and grows behind it. In lock-step "
                    "no case does."));
  connect(leaks_, &QCheckBox::clicked, this, &EvolutionControls::set_leak_rule);
  auto* fold = new Disclosure(tr("Details of the evolution"), QStringLiteral("evolution"));
  form.wide(fold);
  Form details(fold->content());
  add_details(details);
}

void EvolutionControls::add_details(Form& form) {
  steps_ = form.choice(tr("Picture every"), tr("How many steps are computed between two pictures while it "
                                               "plays. Automatic: as many as keep the pictures fluent."));
  for (const std::int64_t steps : kStepsPerPicture) {
    steps_->addItem(steps == 0 ? tr("Automatic")
                               : (steps == 1 ? tr("step") : tr("%n steps", nullptr, static_cast<int>(steps))),
                    QVariant::fromValue<qint64>(steps));
  }
  connect(steps_, &QComboBox::activated, this, [this] {
    if (proxy()) proxy()->set_steps_per_picture(steps_->currentData().toLongLong());
  });
  narrowing_ =
      form.slider(tr("A leak widens by"),
                  tr("How many times wider (in area) than the neck the surface must be behind it, and "
                     "before it, to count as a leak. Fewer: an earlier alarm, and more false ones."));
  narrowing_->set_decimals(1);
  narrowing_->set_range(kLeastNarrowing, kMostNarrowing);
  connect(narrowing_, &SliderNumber::edited, this, &EvolutionControls::set_leak_rule);
  executor_ =
      form.choice(tr("Computed by"), tr("The executor of the steps. It can be changed while the surface "
                                        "moves. Stream uses the GPU as in the paper."));
  connect(executor_, &QComboBox::activated, this, [this](int index) {
    if (proxy()) proxy()->change_executor(kChoices[index].kind);
    refresh();
  });
}

QLayout* EvolutionControls::make_buttons() {
  auto* row = new QHBoxLayout;
  row->setSpacing(kSpaceTight);
  for (QToolButton*& button : buttons_) {
    button = new QToolButton;
    button->setIconSize({kIcon, kIcon});
    button->setAutoRaise(true);
    button->setFocusPolicy(Qt::StrongFocus);
    button->hide();  // until it has an action
    row->addWidget(button);
  }
  state_ = new QLabel;
  state_->setAccessibleName(tr("State of the evolution"));
  row->addStretch(1);
  row->addWidget(state_);
  return row;
}

void EvolutionControls::set_actions(const EvolutionActions& actions) {
  QAction* const in_order[] = {actions.restart, actions.step_back, actions.play, actions.step};
  for (std::size_t index = 0; index < buttons_.size(); ++index) {
    buttons_[index]->setDefaultAction(in_order[index]);
    buttons_[index]->setVisible(in_order[index] != nullptr);
  }
}

void EvolutionControls::set_leak_rule() {
  if (!proxy()) return;
  document::LeakRule rule;
  rule.narrowing = narrowing_->value();
  proxy()->set_leak_rule(leaks_->isChecked() ? std::optional(rule) : std::nullopt);
  narrowing_->setEnabled(leaks_->isChecked());
}

void EvolutionControls::fill_executors() {
  executor_->clear();
  auto* items = qobject_cast<QStandardItemModel*>(executor_->model());
  for (const ExecutorChoice& choice : kChoices) {
    executor_->addItem(title(choice.kind), QLatin1String(choice.name));
    const QString why = obstacle(choice.kind, proxy()->engine());
    if (why.isEmpty()) continue;
    items->item(executor_->count() - 1)->setEnabled(false);
    executor_->setItemText(executor_->count() - 1, tr("%1 (not here)").arg(title(choice.kind)));
    executor_->setItemData(executor_->count() - 1, why, Qt::ToolTipRole);
  }
}

void EvolutionControls::attach() {
  state_->clear();
  if (!proxy()) return;
  fill_executors();
  narrowing_->set_value(proxy()->leak_rule().value_or(document::LeakRule{}).narrowing);
}

void EvolutionControls::refresh() {
  const engine::CaseState& state = proxy()->state();
  state_->setText(!state.begun    ? tr("no surface yet")
                  : state.playing ? tr("playing")
                                  : outcome_word(state.outcome));
  steps_->setCurrentIndex(
      std::max(0, steps_->findData(QVariant::fromValue<qint64>(proxy()->steps_per_picture()))));
  pause_->setChecked(proxy()->pause_at_convergence());
  pace_->set_value(state.pace > 0.0 ? state.pace : kFreePace);
  leaks_->setChecked(proxy()->leak_rule().has_value());
  narrowing_->setEnabled(proxy()->leak_rule().has_value());
  // The executor in use is shown, not "Automatic".
  executor_->setCurrentIndex(executor_->findData(state.executor));
}

}  // namespace tidemark::ui
