#include "ui/widgets/disclosure.h"

#include <QVBoxLayout>

#include "ui/look/theme.h"
#include "ui/settings.h"

namespace tidemark::ui {

Disclosure::Disclosure(const QString& what, const QString& key, QWidget* parent)
    : QWidget(parent), button_(new QToolButton), content_(new QWidget) {
  button_->setText(tr("Details"));
  button_->setAccessibleName(what);
  button_->setToolTip(tr("Shows or hides what is seldom needed."));
  button_->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  button_->setAutoRaise(true);
  button_->setCheckable(true);
  button_->setFocusPolicy(Qt::StrongFocus);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(kSpaceTight);
  column->addWidget(button_, 0, Qt::AlignLeft);
  column->addWidget(content_);
  connect(button_, &QToolButton::toggled, this, [this](bool open) {
    button_->setArrowType(open ? Qt::DownArrow : Qt::RightArrow);
    content_->setVisible(open);
    emit toggled(open);
  });
  connect(button_, &QToolButton::clicked, this, [key](bool open) { settings::details(key).set(open); });
  button_->setArrowType(Qt::RightArrow);
  content_->hide();
  set_open(settings::details(key).get());
}

void Disclosure::set_title(const QString& title) {
  button_->setText(title);
}

void Disclosure::set_open(bool open) {
  button_->setChecked(open);
}

}  // namespace tidemark::ui
