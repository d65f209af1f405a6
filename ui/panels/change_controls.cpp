#include "ui/panels/change_controls.h"

#include <QCheckBox>
#include <QLabel>
#include <QVBoxLayout>

#include "solver/speed/motion_limit.h"
#include "ui/widgets/form.h"
#include "ui/widgets/number_text.h"

namespace tidemark::ui {

ChangeControls::ChangeControls(QWidget* parent) : CaseWidget(parent), content_(new QWidget) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(content_);
  content_->hide();
  Form form(content_);
  form.heading(tr("Refinement"));
  limit_ = form.figure(tr("Stays within"), tr("How far the surface may move from where it began, to both "
                                              "sides. Another start takes the limit away."));
  show_ =
      form.check(tr("Show what has changed"),
                 tr("Orange: what was added since the start. Blue and hatched: what was removed. The dark "
                    "line is where the surface began. In 3D its colour says how far it has moved."));
  connect(show_, &QCheckBox::clicked, this, [this](bool on) {
    change_display([=](engine::DisplaySettings& settings) { settings.change = on; });
  });
}

void ChangeControls::refresh() {
  const auto& limit = proxy()->state().limit;
  content_->setVisible(limit != nullptr);
  if (!limit) return;
  limit_->setText(general_text(limit->within_mm(), 3) + QChar(0x00A0) + tr("mm"));
  show_->setChecked(proxy()->display().settings().change);
}

}  // namespace tidemark::ui
