#include "ui/main/message_bar.h"

#include <QAccessible>
#include <QEvent>
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
  sign_ = new QLabel;
  paint_sign();
  text_ = new QLabel;
  text_->setWordWrap(true);
  text_->setTextFormat(Qt::PlainText);
  text_->setTextInteractionFlags(Qt::TextSelectableByMouse | Qt::TextSelectableByKeyboard);
  text_->setFocusPolicy(Qt::StrongFocus);
  offers_ = new QHBoxLayout;
  dismiss_ = new QPushButton(tr("Dismiss"));
  row->addWidget(sign_);
  row->addWidget(text_, 1);
  row->addLayout(offers_);
  row->addWidget(dismiss_);
  whole->addWidget(line_, 1);
  connect(dismiss_, &QPushButton::clicked, this, &MessageBar::dismiss);
  hide();
}

void MessageBar::paint_sign() {
  sign_->setPixmap(icon(u"warning").pixmap(QSize(kIcon, kIcon), devicePixelRatioF()));
}

// Icons have the colour of the text, which is another one in another theme.
void MessageBar::changeEvent(QEvent* event) {
  QFrame::changeEvent(event);
  if (event->type() == QEvent::PaletteChange) paint_sign();
}

QString MessageBar::text() const {
  return isHidden() || shown_ ? QString() : text_->text();
}

void MessageBar::show_text(const QString& text, const QString& about) {
  dismiss();
  about_ = about;
  text_->setText(text);
  dismiss_->setAccessibleDescription(text);
  line_->show();
  show();
  QAccessibleEvent alert(text_, QAccessible::Alert);
  QAccessible::updateAccessibility(&alert);
}

void MessageBar::show_offers(const QString& text, const QString& about, const std::vector<Offer>& offers) {
  show_text(text, about);
  for (const Offer& offer : offers) {
    auto* button = new QPushButton(offer.button);
    button->setToolTip(offer.tip);
    button->setAccessibleDescription(text);
    offers_->addWidget(button);
    connect(button, &QPushButton::clicked, this, [this, accepted = offer.accepted] {
      dismiss();
      accepted();
    });
  }
}

void MessageBar::mark_as_of(CaseWindow& window) {
  forget_case();
  mark_->setPixmap(case_mark(window.number()).pixmap(QSize(kIconSmall, kIconSmall), devicePixelRatioF()));
  mark_->setAccessibleName(tr("Case %1").arg(window.number()));
  const QString about = tr("About case %1: %2").arg(QString::number(window.number()), window.proxy().name());
  mark_->setToolTip(QStringLiteral("<p>%1</p>").arg(about.toHtmlEscaped()));
  mark_->show();
  case_closed_ = connect(&window, &QObject::destroyed, this, &MessageBar::dismiss);
}

void MessageBar::forget_case() {
  disconnect(case_closed_);
  mark_->hide();
}

void MessageBar::dismiss_about(const QString& about) {
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
  while (QLayoutItem* offer = offers_->takeAt(0)) {
    offer->widget()->hide();
    offer->widget()->deleteLater();
    delete offer;
  }
  forget_case();
  hide();
}

}  // namespace tidemark::ui
