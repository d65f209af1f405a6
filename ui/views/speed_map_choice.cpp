#include "ui/views/speed_map_choice.h"

#include <QButtonGroup>
#include <QHBoxLayout>
#include <QToolButton>

namespace tidemark::ui {

SpeedMapChoice::SpeedMapChoice(engine::CaseProxy& proxy, QWidget* parent) : QWidget(parent), proxy_(proxy) {
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(0);
  speed_ = add(tr("Speed"));
  speed_->setToolTip(tr("Orange: the surface grows here. Blue and hatched: it shrinks."));
  doubt_ = add(tr("Doubt"));
  doubt_->setToolTip(tr("Bright where the examples do not settle what a voxel is: paint there next."));
  auto* group = new QButtonGroup(this);
  group->addButton(speed_);
  group->addButton(doubt_);
  connect(speed_, &QToolButton::clicked, this, [this] {
    if (proxy_.display().settings().speed_term == renderer::SpeedTerm::doubt)
      choose(renderer::SpeedTerm::data);
  });
  connect(doubt_, &QToolButton::clicked, this, [this] { choose(renderer::SpeedTerm::doubt); });
  connect(&proxy_.display(), &engine::Display::changed, this, &SpeedMapChoice::follow);
  connect(&proxy_, &engine::CaseProxy::state_changed, this, &SpeedMapChoice::follow);
  follow();
}

QToolButton* SpeedMapChoice::add(const QString& text) {
  auto* button = new QToolButton;
  button->setText(text);
  button->setAccessibleName(tr("Map of the %1").arg(text.toLower()));
  button->setCheckable(true);
  button->setAutoRaise(true);
  button->setFocusPolicy(Qt::TabFocus);
  layout()->addWidget(button);
  return button;
}

void SpeedMapChoice::choose(renderer::SpeedTerm term) {
  proxy_.display().change([=](engine::DisplaySettings& settings) { settings.speed_term = term; });
}

void SpeedMapChoice::follow() {
  const bool shows_doubt = proxy_.display().settings().speed_term == renderer::SpeedTerm::doubt;
  const bool has_doubt = proxy_.state().speed && proxy_.state().speed->has_doubt();
  (shows_doubt ? doubt_ : speed_)->setChecked(true);
  setVisible(has_doubt || shows_doubt);
}

}  // namespace tidemark::ui
