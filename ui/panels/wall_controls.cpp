#include "ui/panels/wall_controls.h"

#include <QCheckBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QToolButton>

#include "ui/look/icons.h"
#include "ui/look/theme.h"
#include "ui/widgets/form.h"
#include "ui/widgets/number_text.h"
#include "ui/widgets/tr.h"

namespace tidemark::ui {

WallControls::WallControls(QWidget* parent) : CaseWidget(parent) {
  Form form(this);
  form.heading(tr("Walls and anchors"));
  behind_eraser_ = form.check(tr("Erasing leaves a wall"), tr("What is erased does not grow back."));
  connect(behind_eraser_, &QCheckBox::clicked, this, [this](bool on) {
    change_display([=](engine::DisplaySettings& settings) { settings.wall_behind_eraser = on; });
  });
  walls_ = form.figure(tr("Walls"), tr("Where the surface may never come, red and cross-hatched."));
  anchors_ = form.figure(tr("Anchors"), tr("What it always encloses, green and dotted."));
  auto* row = new QHBoxLayout;
  row->setSpacing(kSpace);
  tool_ = new QToolButton;
  tool_->setText(tr("Wall"));
  tool_->setIcon(icon(u"tool-wall"));
  tool_->setIconSize({kIcon, kIcon});
  tool_->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  tool_->setCheckable(true);
  tool_->setFocusPolicy(Qt::StrongFocus);
  tool_->setToolTip(tr("Left button: walls. Shift and left button: anchors. Right button: takes both away."));
  connect(tool_, &QToolButton::clicked, this, [this] {
    if (proxy()) proxy()->display().choose_tool(engine::Tool::wall);
    refresh();
  });
  clear_ = new QPushButton(tr("Clear walls and anchors"));
  clear_->setToolTip(tr("Takes all of them away; Undo brings them back."));
  connect(clear_, &QPushButton::clicked, this, [this] {
    if (!proxy()) return;
    proxy()->change_drive([](document::Drive& drive) { drive.constraints = nullptr; },
                          engine::CaseProxy::new_gesture());
  });
  row->addWidget(tool_);
  row->addWidget(clear_);
  row->addStretch(1);
  form.wide(row);
}

void WallControls::attach() {
  counted_.reset();
  count();
}

void WallControls::count() {
  const auto voxels = [this](solver::Constraint what) {
    const std::int64_t count = counted_ ? counted_->count(what) : 0;
    return count == 0 ? tr("none") : tr("%1 voxels", nullptr, form_of(count)).arg(count_text(count));
  };
  walls_->setText(voxels(solver::Constraint::wall));
  anchors_->setText(voxels(solver::Constraint::anchor));
  clear_->setEnabled(counted_ != nullptr);
}

void WallControls::refresh() {
  const engine::DisplaySettings& settings = proxy()->display().settings();
  behind_eraser_->setChecked(settings.wall_behind_eraser);
  tool_->setChecked(settings.tool == engine::Tool::wall);
  if (proxy()->drive().constraints == counted_) return;
  counted_ = proxy()->drive().constraints;
  count();
}

}  // namespace tidemark::ui
