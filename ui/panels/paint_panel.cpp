#include "ui/panels/paint_panel.h"

#include <QAction>
#include <QButtonGroup>
#include <QHBoxLayout>
#include <QLabel>
#include <QToolButton>

#include "ui/look/icons.h"
#include "ui/look/theme.h"
#include "ui/panels/wall_controls.h"
#include "ui/widgets/form.h"
#include "ui/widgets/number_text.h"
#include "ui/widgets/slider_number.h"

namespace tidemark::ui {
namespace {

constexpr double kSmallestMm = 0.5;  // mm
constexpr double kLargestMm = 100.0;

}  // namespace

PaintPanel::PaintPanel(QWidget* parent) : Panel(tr("Open a study to paint in it."), parent) {
  auto* part = new QWidget;
  Form form(part);
  form.heading(tr("Brush"));
  form.wide(make_tools());
  radius_ = form.slider(tr("Radius"), tr("Of the sphere that is painted or erased. In a view: Shift and the "
                                         "wheel."));
  radius_->set_decimals(1);
  radius_->set_range(kSmallestMm, kLargestMm, SliderNumber::Scale::logarithmic);
  radius_->set_unit(tr("mm"));
  connect(radius_, &SliderNumber::edited, this, [this](double value) {
    change_display([=](engine::DisplaySettings& settings) { settings.brush_mm = value; });
  });
  voxels_ = form.figure(tr("In voxels"), tr("The radius along columns, rows and slices."));
  add(part);
  add(new WallControls);
  auto* rest = new QWidget;
  Form below(rest);
  below.heading(tr("Take back"));
  below.wide(make_history());
  below.heading(tr("In a view"));
  below.note(
      tr("Left drag: the chosen tool\nRight drag: the other one\nShift and wheel: radius\n"
         "Alt and drag: window and level\nThe surface goes on moving while you paint."));
  add(rest);
}

QWidget* PaintPanel::make_tools() {
  auto* row = new QWidget;
  auto* layout = new QHBoxLayout(row);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(kSpace);
  tools_ = new QButtonGroup(this);
  const auto add_tool = [&](engine::Tool tool, QStringView picture, const QString& text, const QString& tip) {
    auto* button = new QToolButton;
    button->setText(text);
    button->setIcon(icon(picture));
    button->setIconSize({kIcon, kIcon});
    button->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
    button->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    button->setCheckable(true);
    button->setFocusPolicy(Qt::StrongFocus);
    button->setToolTip(tip);
    button->setAccessibleName(text);
    tools_->addButton(button, static_cast<int>(tool));
    layout->addWidget(button);
  };
  add_tool(engine::Tool::paint, u"tool-paint", tr("Paint"), tr("Adds spheres to the inside of the surface."));
  add_tool(engine::Tool::erase, u"tool-erase", tr("Erase"), tr("Takes spheres away from it."));
  connect(tools_, &QButtonGroup::idClicked, this, [this](int tool) {
    if (proxy()) proxy()->display().choose_tool(static_cast<engine::Tool>(tool));
  });
  return row;
}

QWidget* PaintPanel::make_history() {
  auto* row = new QWidget;
  auto* layout = new QVBoxLayout(row);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(kSpaceTight);
  for (QToolButton** button : {&undo_, &redo_}) {
    *button = new QToolButton;
    (*button)->setIconSize({kIcon, kIcon});
    (*button)->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
    // Their texts name the change, and must not make the panel wider.
    (*button)->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
    (*button)->setFocusPolicy(Qt::StrongFocus);
    (*button)->hide();  // until it has an action
    layout->addWidget(*button);
  }
  return row;
}

void PaintPanel::set_actions(QAction* undo, QAction* redo) {
  undo_->setDefaultAction(undo);
  redo_->setDefaultAction(redo);
  undo_->setVisible(undo != nullptr);
  redo_->setVisible(redo != nullptr);
}

void PaintPanel::refresh() {
  const engine::DisplaySettings& settings = proxy()->display().settings();
  // With another tool neither is chosen, which an exclusive group does not allow otherwise.
  tools_->setExclusive(false);
  for (QAbstractButton* button : tools_->buttons()) {
    button->setChecked(tools_->id(button) == static_cast<int>(settings.tool));
  }
  tools_->setExclusive(true);
  radius_->set_value(settings.brush_mm);
  const glm::dvec3 radius = settings.brush_mm / proxy()->volume().geometry.spacing_mm;
  voxels_->setText(QStringLiteral("%1 × %2 × %3")
                       .arg(number_text(radius.x, 1), number_text(radius.y, 1), number_text(radius.z, 1)));
}

}  // namespace tidemark::ui
