#include "ui/passes/passes_panel.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QScrollArea>
#include <QToolButton>
#include <QVBoxLayout>

#include "engine/case_passes.h"
#include "engine/message_text.h"
#include "ui/look/theme.h"
#include "ui/passes/pass_cards.h"
#include "ui/widgets/form.h"
#include "ui/widgets/number_text.h"
#include "ui/widgets/wheel_guard.h"

namespace tidemark::ui {

using Follow = engine::CasePasses::Follow;

PassesPanel::PassesPanel(QWidget* parent)
    : CaseWidget(parent),
      follow_(new QComboBox),
      play_(new QToolButton),
      step_(new QToolButton),
      status_(make_note({})),
      use_stream_(new QPushButton(tr("Compute with the stream executor"))),
      scroll_(new QScrollArea),
      cards_(new PassCards) {
  follow_->addItem(tr("Page under the crosshair"), static_cast<int>(Follow::crosshair));
  follow_->addItem(tr("Page that moves most"), static_cast<int>(Follow::motion));
  follow_->setAccessibleName(tr("Page"));
  follow_->setToolTip(
      tr("The page that is followed. The crosshair is moved by its tool, and with Shift held."));
  guard_wheel(follow_);
  connect(follow_, &QComboBox::activated, this, [this] {
    if (proxy()) proxy()->passes().set_follow(static_cast<Follow>(follow_->currentData().toInt()));
  });
  use_stream_->setToolTip(tr("It runs the paper's passes by OpenGL. The surface goes on from where it is."));
  connect(use_stream_, &QPushButton::clicked, this, [this] {
    if (proxy()) proxy()->change_executor(solver::ExecutorKind::stream);
  });
  auto* row = new QHBoxLayout;
  row->setContentsMargins(kSpace, kSpaceTight, kSpace, 0);
  row->addWidget(follow_, 1);
  for (QToolButton* button : {step_, play_}) {
    button->setIconSize({kIcon, kIcon});
    button->setAutoRaise(true);
    button->setFocusPolicy(Qt::StrongFocus);
    row->addWidget(button);
  }
  auto* words = new QVBoxLayout;
  words->setContentsMargins(kSpace, 0, kSpace, 0);
  words->addWidget(status_);
  words->addWidget(use_stream_);
  scroll_->setWidget(cards_);
  scroll_->setWidgetResizable(true);
  scroll_->setFrameShape(QFrame::NoFrame);
  scroll_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins({});
  column->addLayout(row);
  column->addLayout(words);
  column->addWidget(scroll_, 1);
  show_passes();
}

void PassesPanel::set_actions(QAction* play, QAction* step) {
  play_->setDefaultAction(play);
  step_->setDefaultAction(step);
}

void PassesPanel::attach() {
  disconnect(changed_);
  if (watched_) watched_->passes().set_watched(false);
  watched_ = proxy();
  if (proxy()) {
    changed_ = connect(&proxy()->passes(), &engine::CasePasses::changed, this, &PassesPanel::show_passes);
    proxy()->passes().set_watched(isVisible());
  }
  show_passes();
}

void PassesPanel::showEvent(QShowEvent* event) {
  CaseWidget::showEvent(event);
  if (proxy()) proxy()->passes().set_watched(true);
  show_passes();
}

void PassesPanel::hideEvent(QHideEvent* event) {
  CaseWidget::hideEvent(event);
  if (proxy()) proxy()->passes().set_watched(false);
}

void PassesPanel::refresh() {
  show_passes();
}

QString PassesPanel::status() const {
  if (!proxy()) return tr("Open a study to follow a page of its level set.");
  const engine::CaseState& state = proxy()->state();
  if (!state.begun) return tr("Once there is a surface, this follows a page of it through a step.");
  const engine::CasePasses& passes = proxy()->passes();
  if (!passes.available()) {
    if (proxy()->engine().graphics() == engine::Engine::Graphics::none)
      return tr("The passes are those of the stream executor, which needs OpenGL; there is none here.");
    return tr("The passes are those of the stream executor. This surface is computed by %1.")
        .arg(state.executor);
  }
  if (!passes.problem().empty()) return engine::message_text(passes.problem());
  if (!passes.recorded()) return {};
  return tr("Step %1, read back from the buffers of the passes.")
      .arg(count_text(passes.recorded()->step + 1));
}

void PassesPanel::show_passes() {
  if (proxy() && !isVisible()) return;
  const bool has_stream = proxy() && proxy()->passes().available();
  const bool can_have = proxy() && proxy()->state().begun && !has_stream &&
                        proxy()->engine().graphics() != engine::Engine::Graphics::none;
  use_stream_->setVisible(can_have);
  follow_->setEnabled(has_stream);
  if (proxy()) follow_->setCurrentIndex(follow_->findData(static_cast<int>(proxy()->passes().follow())));
  status_->setText(status());
  const auto recorded = has_stream ? proxy()->passes().recorded() : nullptr;
  scroll_->setVisible(recorded != nullptr);
  cards_->show_record(recorded);
}

}  // namespace tidemark::ui
