#include "ui/panels/balance_controls.h"

#include <QCheckBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

#include "engine/case_balance.h"
#include "ui/look/theme.h"
#include "ui/panels/balance_bars.h"
#include "ui/panels/balance_text.h"
#include "ui/panels/value_unit.h"
#include "ui/views/driven_by.h"
#include "ui/widgets/form.h"
#include "ui/widgets/into_sight.h"
#include "ui/widgets/number_text.h"

namespace tidemark::ui {

BalanceControls::BalanceControls(QWidget* parent) : CaseWidget(parent), content_(new QWidget) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(content_);
  content_->hide();
  Form form(content_);
  form.heading(tr("Why here?"));
  found_ = new QWidget;
  Form found(found_);
  bars_ = new BalanceBars;
  found.wide(bars_);
  pace_ = found.figure(tr("In a unit of time"),
                       tr("The sum of the pushes. A front that the data drive as fast as can be, at α = 1, "
                          "moves by the smallest voxel spacing in a unit of time."));
  step_ = found.figure(tr("In the next step"), tr("How much the sum changes φ, and with it the surface."));
  brightness_ = found.figure(tr("Brightness"), tr("The value of the source here, as D sees it."));
  speed_ = found.figure(tr("Speed D"), tr("What the data ask for here, from −1, inward, to 1, outward."));
  form.wide(found_);
  why_ = form.note({});
  auto* buttons = new QHBoxLayout;
  buttons->setSpacing(kSpace);
  fastest_ = new QPushButton(tr("Where it moves most"));
  fastest_->setToolTip(tr("Go to the place where the surface still moves most, and see why."));
  forget_ = new QPushButton(tr("Clear"));
  forget_->setToolTip(tr("Forget the place."));
  buttons->addWidget(fastest_, 1);
  buttons->addWidget(forget_);
  form.wide(buttons);
  forces_ = form.check(tr("Arrows of the terms"),
                       tr("Shows on the surface, in slices and in 3D, how the data and the other terms push "
                          "it, while it moves, too."));
  connect(fastest_, &QPushButton::clicked, this, [this] {
    if (proxy()) proxy()->balance().ask_fastest();
  });
  connect(forget_, &QPushButton::clicked, this, [this] {
    if (proxy()) proxy()->balance().forget();
  });
  connect(forces_, &QCheckBox::clicked, this, [this](bool on) {
    change_display([=](engine::DisplaySettings& settings) { settings.forces = on; });
  });
}

void BalanceControls::attach() {
  disconnect(changed_);
  disconnect(wanted_);
  if (!proxy()) return;
  const engine::CaseBalance* balance = &proxy()->balance();
  changed_ = connect(balance, &engine::CaseBalance::changed, this, [this] {
    if (proxy() && isVisible()) refresh();
  });
  // The panel may be coming to the front.
  wanted_ = connect(balance, &engine::CaseBalance::show_wanted, this, &BalanceControls::scroll_here,
                    Qt::QueuedConnection);
}

// What is to be seen is known before its place is.
void BalanceControls::resizeEvent(QResizeEvent* event) {
  CaseWidget::resizeEvent(event);
  if (std::exchange(comes_to_sight_, false))
    QMetaObject::invokeMethod(this, &BalanceControls::scroll_here, Qt::QueuedConnection);
}

void BalanceControls::scroll_here() {
  bring_into_sight(*this);
}

void BalanceControls::refresh() {
  const engine::CaseBalance& balance = proxy()->balance();
  const bool begun = proxy()->state().begun;
  const engine::DisplaySettings& settings = proxy()->display().settings();
  content_->setVisible(balance.asked() || settings.forces || settings.tool == engine::Tool::why);
  fastest_->setEnabled(begun);
  forget_->setEnabled(balance.asked());
  forces_->setChecked(settings.forces);
  const bool was_found = found_->isVisibleTo(this);
  found_->setVisible(balance.place().has_value());
  if (balance.place()) {
    show_place();
    comes_to_sight_ = comes_to_sight_ || !was_found;
  } else if (!begun) {
    why_->setText(tr("Once there is a surface, this says why it moves or rests at a place."));
  } else if (proxy()->state().lacks_speed) {
    why_->setText(lacking_speed_text(proxy()->state()));
  } else if (!balance.asked()) {
    why_->setText(tr("Choose the tool Why here? and click on the surface, or point at it with Ctrl held."));
  } else if (!balance.waits()) {
    why_->setText(tr("There is no surface near that place."));
  }
}

void BalanceControls::show_place() {
  const engine::ExplainedPlace& place = *proxy()->balance().place();
  const engine::SourceSummary& summary = proxy()->summary();
  const int decimals = value_decimals(summary.high - summary.low);
  bars_->set_place(place);
  pace_->setText(tr("%1 mm").arg(short_text(place.sum_mm(), 2)));
  step_->setText(tr("%1 mm").arg(short_text(place.sum_mm() * place.time_step, 2)));
  brightness_->setText(brightness_text(place, decimals, value_unit(proxy()->volume())));
  speed_->setText(number_text(place.balance.speed, 2));
  why_->setText(why_text(place, decimals));
}

}  // namespace tidemark::ui
