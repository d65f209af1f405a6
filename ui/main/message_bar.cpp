#include "ui/main/message_bar.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

#include "ui/look/icons.h"
#include "ui/look/theme.h"

namespace tidemark::ui {

MessageBar::MessageBar(QWidget* parent) : QFrame(parent) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  line_ = new QWidget;
  auto* row = new QHBoxLayout(line_);
  row->setContentsMargins(kSpace, kSpaceTight, kSpace, kSpaceTight);
  auto* sign = new QLabel;
  sign->setPixmap(icon(u"warning").pixmap(kIcon, kIcon));
  text_ = new QLabel;
  text_->setWordWrap(true);
  text_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  offer_ = new QPushButton;
  auto* button = new QPushButton(tr("Dismiss"));
  row->addWidget(sign);
  row->addWidget(text_, 1);
  row->addWidget(offer_);
  row->addWidget(button);
  column->addWidget(line_);
  connect(button, &QPushButton::clicked, this, &MessageBar::dismiss);
  connect(offer_, &QPushButton::clicked, this, [this] {
    const auto accepted = accepted_;
    dismiss();
    accepted();
  });
  hide();
}

QString MessageBar::text() const {
  return isHidden() || shown_ ? QString() : text_->text();
}

void MessageBar::show_text(const QString& text, const QString& about) {
  dismiss();
  about_ = about;
  text_->setText(text);
  offer_->hide();
  line_->show();
  show();
}

void MessageBar::show_offer(const QString& text, const QString& about, const QString& button,
                            std::function<void()> accepted) {
  show_text(text, about);
  accepted_ = std::move(accepted);
  offer_->setText(button);
  offer_->show();
}

void MessageBar::settle(const QString& about) {
  if (!about.isEmpty() && about == about_) dismiss();
}

void MessageBar::show_widget(QWidget* widget) {
  dismiss();
  line_->hide();
  shown_ = widget;
  layout()->addWidget(widget);
  show();
}

void MessageBar::dismiss() {
  if (shown_) shown_->deleteLater();
  shown_ = nullptr;
  about_.clear();
  hide();
}

}  // namespace tidemark::ui
