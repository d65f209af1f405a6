#include "ui/widgets/disclosure.h"

#include <QSettings>
#include <QVBoxLayout>

#include "ui/look/theme.h"

namespace tidemark::ui {

Disclosure::Disclosure(const QString& what, const QString& key, QWidget* parent)
    : QWidget(parent), button_(new QToolButton), content_(new QWidget) {
  const QString setting = QStringLiteral("details/") + key;
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
  });
  connect(button_, &QToolButton::clicked, this,
          [setting](bool open) { QSettings().setValue(setting, open); });
  button_->setArrowType(Qt::RightArrow);
  content_->hide();
  set_open(QSettings().value(setting, false).toBool());
}

void Disclosure::set_open(bool open) {
  button_->setChecked(open);
}

}  // namespace tidemark::ui
