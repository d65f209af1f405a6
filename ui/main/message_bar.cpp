#include "ui/main/message_bar.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

#include "ui/look/icons.h"
#include "ui/look/theme.h"
#include "ui/main/case_head.h"
#include "ui/main/case_window.h"

namespace tidemark::ui {

MessageBar::MessageBar(QWidget* parent) : QFrame(parent) {
  auto* whole = new QHBoxLayout(this);
  whole->setContentsMargins(0, 0, 0, 0);
  whole->setSpacing(0);
  mark_ = new QLabel;
  mark_->setContentsMargins(kSpace, 0, 0, 0);
  mark_->hide();
  whole->addWidget(mark_);
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
  whole->addWidget(line_, 1);
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

void MessageBar::mark_as_of(CaseWindow& window) {
  forget_case();
  mark_->setPixmap(case_mark(window.number()).pixmap(QSize(kIconSmall, kIconSmall), devicePixelRatioF()));
  mark_->setAccessibleName(tr("Case %1").arg(window.number()));
  mark_->setToolTip(tr("About case %1: %2").arg(window.number()).arg(window.proxy().name()));
  mark_->show();
  case_closed_ = connect(&window, &QObject::destroyed, this, &MessageBar::dismiss);
}

void MessageBar::forget_case() {
  disconnect(case_closed_);
  mark_->hide();
}

void MessageBar::settle(const QString& about) {
  if (!about.isEmpty() && about == about_) dismiss();
}

void MessageBar::show_widget(QWidget* widget) {
  dismiss();
  line_->hide();
  shown_ = widget;
  static_cast<QHBoxLayout*>(layout())->addWidget(widget, 1);
  show();
}

void MessageBar::dismiss() {
  if (shown_) shown_->deleteLater();
  shown_ = nullptr;
  about_.clear();
  forget_case();
  hide();
}

}  // namespace tidemark::ui
