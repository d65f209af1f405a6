#include "ui/views/view_bar.h"

#include <QAction>
#include <QEvent>
#include <QHBoxLayout>
#include <QMenu>
#include <algorithm>

#include "ui/look/icons.h"
#include "ui/views/driven_by.h"
#include "ui/views/play.h"
#include "ui/widgets/elided_label.h"

namespace tidemark::ui {
namespace {

constexpr int kLeastTitleWidth = 60;

}  // namespace

ViewBar::ViewBar(engine::CaseProxy& proxy, const QString& title, const QList<QAction*>& tools,
                 QWidget* parent)
    : QWidget(parent), proxy_(proxy), tools_(tools) {
  auto* layout = new QHBoxLayout(this);
  layout->setContentsMargins(8, 1, 2, 1);
  layout->setSpacing(2);
  title_ = new ElidedLabel(title);
  layout->addWidget(title_, 1);
  play_ = add_button("play", tr("Play or pause the evolution of the surface"));
  connect(play_, &QToolButton::clicked, this, [this] { toggle_play(proxy_); });
  step_ = add_button("step", tr("Compute one step"));
  connect(step_, &QToolButton::clicked, &proxy_, [this] { proxy_.step(); });
  target_ = add_number(&solver::Parameters::target, tr("T"), tr("Target T"),
                       tr("T: the brightness that attracts the surface"));
  range_ = add_number(&solver::Parameters::range, tr("ε"), tr("Range epsilon"),
                      tr("ε: the surface grows where brightness is within T ± ε"));
  tool_ = new QToolButton;
  tool_->setAutoRaise(true);
  tool_->setPopupMode(QToolButton::InstantPopup);
  tool_->setAccessibleName(tr("Tool"));
  auto* menu = new QMenu(tool_);
  menu->addActions(tools);
  tool_->setMenu(menu);
  layout->addWidget(tool_);
  QToolButton* maximise = add_button("maximise", tr("Maximise or restore the view (double click)"));
  connect(maximise, &QToolButton::clicked, this, &ViewBar::maximise_wanted);
  QToolButton* floats = add_button("duplicate", tr("Let the view float, or put it back"));
  connect(floats, &QToolButton::clicked, this, &ViewBar::float_wanted);
  QToolButton* close = add_button("close", tr("Close the view"));
  connect(close, &QToolButton::clicked, this, &ViewBar::close_wanted);
  other_buttons_ = {maximise, floats, tool_};
  lasting_ << close;
  connect(&proxy_, &engine::CaseProxy::state_changed, this, &ViewBar::follow_state);
  connect(&proxy_.display(), &engine::Display::changed, this, &ViewBar::follow_tool);
  follow_state();
  follow_tool();
}

QToolButton* ViewBar::add_button(const char* picture, const QString& text) {
  auto* button = new QToolButton;
  button->setIcon(icon(QString::fromLatin1(picture)));
  button->setToolTip(text);
  button->setAccessibleName(text);
  button->setAutoRaise(true);
  button->setFocusPolicy(Qt::TabFocus);
  layout()->addWidget(button);
  return button;
}

NumberBox* ViewBar::add_number(double solver::Parameters::*parameter, const QString& label,
                               const QString& name, const QString& tip) {
  auto* text = new QLabel(label);
  auto* number = new NumberBox;
  text->setBuddy(number);
  number->setAccessibleName(name);
  number->setToolTip(tip);
  number->setFrame(false);
  number->setButtonSymbols(QAbstractSpinBox::NoButtons);
  number->setAlignment(Qt::AlignRight);
  number->setFixedWidth(62);
  const engine::SourceSummary& summary = proxy_.summary();
  const double span = std::max<double>(summary.highest - summary.lowest, 1e-3);
  number->setRange(-1e7, 1e7);
  number->setDecimals(span > 100.0 ? 1 : 4);
  number->setSingleStep(span / 500.0);
  layout()->addWidget(text);
  layout()->addWidget(number);
  numbers_ << text << number;
  connect(number, &NumberBox::valueChanged, this,
          [this, parameter](double value) { change(parameter, value); });
  return number;
}

void ViewBar::add_choice(QWidget* choice) {
  static_cast<QHBoxLayout*>(layout())->insertWidget(1, choice);
  lasting_ << choice;
  show_what_fits();
}

// The other parameters keep all their digits, of which the bar shows a few.
void ViewBar::change(double solver::Parameters::*parameter, double value) {
  proxy_.change_parameters([parameter, value](solver::Parameters& parameters) {
    parameters.*parameter = value;
    parameters.range = std::max(parameters.range, solver::kMinimumRange);
  });
}

void ViewBar::follow_state() {
  show_what_fits();
  follow_evolution();
  target_->show_unless_typed(proxy_.parameters().target);
  range_->show_unless_typed(proxy_.parameters().range);
}

void ViewBar::follow_evolution() {
  const engine::CaseState& state = proxy_.state();
  play_->setEnabled(can_play(proxy_));
  step_->setEnabled(state.begun);
  const QString name = state.playing ? tr("Pause") : tr("Play");
  if (play_->accessibleName() == name) return;
  play_->setAccessibleName(name);
  play_->setIcon(icon(state.playing ? u"pause" : u"play"));
}

void ViewBar::follow_tool() {
  const int tool = static_cast<int>(proxy_.display().settings().tool);
  const auto chosen = std::find_if(tools_.begin(), tools_.end(),
                                   [&](const QAction* action) { return action->data().toInt() == tool; });
  if (chosen == tools_.end()) return;
  tool_->setIcon((*chosen)->icon());
  tool_->setToolTip(tr("Tool: %1").arg((*chosen)->toolTip()));
}

void ViewBar::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  show_what_fits();
}

// Another font gives the parts other sizes.
bool ViewBar::event(QEvent* event) {
  if (event->type() == QEvent::LayoutRequest) show_what_fits();
  return QWidget::event(event);
}

QSize ViewBar::minimumSizeHint() const {
  return {std::max(kLeastTitleWidth, room_for(lasting())), sizeHint().height()};
}

// Without a choice that hides itself.
QList<QWidget*> ViewBar::lasting() const {
  QList<QWidget*> parts = lasting_;
  parts.removeIf([](const QWidget* part) { return part->isHidden(); });
  return parts;
}

// With the margins at both ends.
int ViewBar::room_for(const QList<QWidget*>& parts) const {
  const QMargins margins = layout()->contentsMargins();
  int room = margins.left() + margins.right();
  for (const QWidget* part : parts)
    room += std::min(part->sizeHint().width(), part->maximumWidth()) + layout()->spacing();
  return room;
}

// T and epsilon are the tent's. The title is cut before a button goes; the evolution's leave it its words,
// and numbers its beginning.
void ViewBar::show_what_fits() {
  QList<QWidget*> shown = lasting();
  bool fits = true;
  const auto show = [&](const QList<QWidget*>& parts, int beside) {
    fits = fits && room_for(shown + parts) + beside <= width();
    if (fits) shown += parts;
    for (QWidget* part : parts) part->setVisible(fits);
  };
  for (QWidget* button : other_buttons_) show({button}, 0);
  const int title = title_->sizeHint().width();
  show({play_, step_}, title);
  fits = fits && is_driven_by(proxy_.drive(), "tent");
  show(numbers_, std::min(title, kLeastTitleWidth));
}

}  // namespace tidemark::ui
