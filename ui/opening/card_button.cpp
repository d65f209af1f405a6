#include "ui/opening/card_button.h"

#include <QEvent>
#include <QFontMetrics>
#include <QKeyEvent>
#include <QPainter>
#include <algorithm>

namespace tidemark::ui {
namespace {

constexpr int kPadding = 12;
constexpr int kTitleGap = 3;  // between title and sentence
constexpr double kCardRadius = 6.0;
constexpr int kWishedWidth = 300;
constexpr int kLeastCardWidth = 150;
constexpr int kPictureSide = 56;
constexpr int kWrapped = Qt::AlignTop | Qt::AlignLeft | Qt::TextWordWrap;

int wrapped_height(const QFontMetrics& metrics, const QString& text, int room) {
  return metrics.boundingRect(0, 0, room, 10'000, kWrapped, text).height();
}

int longest_word(const QFontMetrics& metrics, const QString& text) {
  int longest = 0;
  for (const QString& word : text.split(' ')) longest = std::max(longest, metrics.horizontalAdvance(word));
  return longest;
}

}  // namespace

CardButton::CardButton(const QString& title, const QString& sentence, QWidget* parent)
    : QAbstractButton(parent), sentence_(sentence) {
  setText(title);
  setAccessibleName(title);
  setAccessibleDescription(sentence);
  setFocusPolicy(Qt::StrongFocus);
  setCursor(Qt::PointingHandCursor);
  setMouseTracking(true);
  QSizePolicy policy(QSizePolicy::Expanding, QSizePolicy::Preferred);
  policy.setHeightForWidth(true);
  setSizePolicy(policy);
}

void CardButton::set_emphasised(bool emphasised) {
  emphasised_ = emphasised;
  update();
}

void CardButton::set_one_line(bool one_line) {
  one_line_ = one_line;
  setToolTip(one_line ? sentence_ : QString());
  updateGeometry();
}

void CardButton::set_picture(const QImage& picture) {
  picture_ = QPixmap::fromImage(picture);
  updateGeometry();
  update();
}

int CardButton::text_left() const {
  return picture_.isNull() ? kPadding : 2 * kPadding + kPictureSide;
}

QFont CardButton::title_font() const {
  QFont bold = font();
  bold.setWeight(QFont::DemiBold);
  return bold;
}

QSize CardButton::sizeHint() const {
  return {kWishedWidth, heightForWidth(kWishedWidth)};
}

QSize CardButton::minimumSizeHint() const {
  if (one_line_) return {kLeastCardWidth, heightForWidth(kLeastCardWidth)};
  const int word = std::max(longest_word(QFontMetrics(title_font()), text()),
                            longest_word(QFontMetrics(font()), sentence_));
  return {std::max(kLeastCardWidth, text_left() + word + kPadding), heightForWidth(kWishedWidth)};
}

int CardButton::title_height(int room) const {
  const QFontMetrics title(title_font());
  return one_line_ ? title.height() : wrapped_height(title, text(), room);
}

int CardButton::heightForWidth(int width) const {
  const QFontMetrics text(font());
  const int room = std::max(1, width - text_left() - kPadding);
  const int lines = one_line_ ? text.height() : wrapped_height(text, sentence_, room);
  const int texts = title_height(room) + kTitleGap + lines;
  return 2 * kPadding + std::max(texts, picture_.isNull() ? 0 : kPictureSide);
}

void CardButton::paint_frame(QPainter& painter) const {
  const QPalette& colours = palette();
  const QColor accent = colours.color(QPalette::Highlight);
  const QColor text = colours.color(QPalette::WindowText);
  QColor fill = colours.color(QPalette::Base);
  QColor line = mixed(colours.color(QPalette::Window), text, 0.22);
  if (emphasised_) {
    fill = mixed(fill, accent, 0.16);
    line = accent;
  }
  if (isEnabled() && hovered_) fill = mixed(fill, accent, 0.12);
  if (isDown()) fill = mixed(fill, accent, 0.25);
  const double width = hasFocus() ? 2.0 : 1.0;
  painter.setPen(QPen(hasFocus() ? accent : line, width));
  painter.setBrush(fill);
  painter.drawRoundedRect(QRectF(rect()).adjusted(1.0, 1.0, -1.0, -1.0), kCardRadius, kCardRadius);
  if (emphasised_ && hasFocus()) {  // its line has the colour of focus anyway
    painter.setBrush(Qt::NoBrush);
    painter.drawRoundedRect(QRectF(rect()).adjusted(4.0, 4.0, -4.0, -4.0), kCardRadius - 2.0,
                            kCardRadius - 2.0);
  }
}

// Whole, on black, in a square at the left.
void CardButton::paint_picture(QPainter& painter) const {
  if (picture_.isNull()) return;
  const QRect square(kPadding, (height() - kPictureSide) / 2, kPictureSide, kPictureSide);
  QRect place(QPoint(), picture_.size().scaled(square.size(), Qt::KeepAspectRatio));
  place.moveCenter(square.center());
  painter.save();
  painter.setRenderHint(QPainter::SmoothPixmapTransform);
  painter.setOpacity(isEnabled() ? 1.0 : 0.4);
  painter.fillRect(square, Qt::black);
  painter.drawPixmap(place, picture_);
  painter.restore();
}

void CardButton::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  paint_frame(painter);
  paint_picture(painter);
  const QPalette::ColorGroup group = isEnabled() ? QPalette::Active : QPalette::Disabled;
  const QColor strong = palette().color(group, QPalette::WindowText);
  const QRect inside = rect().adjusted(text_left(), kPadding, -kPadding, -kPadding);
  // As much of a text as has room.
  const auto draw = [&](const QRect& room, const QString& text, Qt::TextElideMode elide) {
    if (!one_line_) return painter.drawText(room, kWrapped, text);
    painter.drawText(room, Qt::AlignTop | Qt::AlignLeft | Qt::TextSingleLine,
                     painter.fontMetrics().elidedText(text, elide, room.width()));
  };
  painter.setFont(title_font());
  painter.setPen(strong);
  draw(inside, text(), Qt::ElideRight);
  painter.setFont(font());
  painter.setPen(mixed(strong, palette().color(QPalette::Base), 0.25));
  draw(inside.adjusted(0, title_height(inside.width()) + kTitleGap, 0, 0), sentence_, Qt::ElideMiddle);
}

void CardButton::keyPressEvent(QKeyEvent* event) {
  if (event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter) {
    click();
  } else {
    QAbstractButton::keyPressEvent(event);
  }
}

bool CardButton::event(QEvent* event) {
  // No Leave comes to a card whose page goes, or that a dialog covers, while the mouse is on it.
  const bool before = hovered_;
  switch (event->type()) {
    case QEvent::Enter:
    case QEvent::MouseMove:
      hovered_ = true;
      break;
    case QEvent::Leave:
    case QEvent::Hide:
    case QEvent::WindowDeactivate:
    case QEvent::WindowBlocked:
      hovered_ = false;
      break;
    default:
      break;
  }
  if (hovered_ != before) update();
  return QAbstractButton::event(event);
}

}  // namespace tidemark::ui
