#include "ui/widgets/number_box.h"

#include <QHelpEvent>
#include <QKeyEvent>
#include <QLineEdit>
#include <QPainter>
#include <QRegularExpression>
#include <QSignalBlocker>
#include <QToolTip>
#include <cmath>
#include <optional>

#include "ui/look/theme.h"
#include "ui/widgets/number_text.h"

namespace tidemark::ui {
namespace {

constexpr QChar kMinus(0x2212);
constexpr QChar kArabicDecimalPoint(0x066B);

bool is_point(QChar c) {
  return c == u'.' || c == u',' || c == kArabicDecimalPoint;
}

// What says in which direction a sign is written: languages from right to left have it before their minus.
bool is_direction_mark(QChar c) {
  return c == QChar(0x200E) || c == QChar(0x200F) || c == QChar(0x061C);
}

// What other programs put between groups of digits.
bool is_group_separator(QChar c) {
  return c.isSpace() || c == u'\'' || c == u'’';
}

bool is_letter(const QKeyEvent& key) {
  const QString typed = key.text();
  return (key.modifiers() & ~Qt::ShiftModifier) == 0 && typed.size() == 1 && typed.front().isLetter();
}

// The typed text as C writes numbers; nothing where it holds something that is no part of any number.
std::optional<QString> in_ascii(const QString& typed) {
  QString plain;
  for (const QChar c : typed) {
    if (c.digitValue() >= 0) {
      plain += QChar(u'0' + c.digitValue());
    } else if (is_point(c)) {
      plain += u'.';
    } else if (c == u'-' || c == kMinus) {
      plain += u'-';
    } else if (c == u'+' || c == u'e' || c == u'E' || is_group_separator(c)) {
      plain += c;
    } else if (!is_direction_mark(c)) {
      return std::nullopt;
    }
  }
  return plain;
}

}  // namespace

NumberBox::NumberBox(QWidget* parent) : QDoubleSpinBox(parent) {
  setKeyboardTracking(false);
}

bool NumberBox::is_being_typed() const {
  return hasFocus() && (cleanText() != textFromValue(value()) || !problem().isEmpty());
}

void NumberBox::show_unless_typed(double value) {
  if (is_being_typed()) return;
  const QSignalBlocker quiet(this);
  setValue(value);
}

void NumberBox::show_value(double value) {
  refused_.clear();
  setValue(value);
}

QString NumberBox::typed_in(const QString& text) const {
  QStringView typed(text);
  if (typed.startsWith(prefix())) typed = typed.mid(prefix().size());
  if (typed.endsWith(suffix())) typed.chop(suffix().size());
  return typed.trimmed().toString();
}

// A unit that is typed, as far as it is.
QString NumberBox::without_unit(const QString& typed) const {
  qsizetype letters = typed.size();
  while (letters > 0 && typed[letters - 1].isLetter()) --letters;
  const QString unit = suffix().trimmed();
  const QString end = typed.mid(letters);
  return !end.isEmpty() && unit.startsWith(end, Qt::CaseInsensitive) ? typed.left(letters).trimmed() : typed;
}

// More digits behind it take a number away from zero only.
bool NumberBox::can_become_larger_only(double value) const {
  return (value >= 0.0 && value < minimum()) || (value <= 0.0 && value > maximum());
}

NumberBox::Typed NumberBox::read(const QString& typed) const {
  const auto plain = in_ascii(without_unit(typed));
  if (!plain) return {Reading::no_number};
  if (plain->isEmpty() || *plain == u"-" || *plain == u"+" || *plain == u"." || *plain == u"-.") return {};
  static const QRegularExpression begun_exponent(QStringLiteral("^[-+]?[0-9.]+[eE][-+]?$"));
  if (begun_exponent.match(*plain).hasMatch()) return {};
  bool is_number = false;
  const double value = QLocale::c().toDouble(*plain, &is_number);
  if (!is_number || !std::isfinite(value)) return {Reading::no_number};
  if (value < minimum() || value > maximum()) return {Reading::out_of_range, value};
  const double held = rounded(value, decimals());
  if (std::abs(held - value) > 1e-6 * std::pow(10.0, -decimals())) return {Reading::too_fine, value};
  // As many digits as a group has, in a box that keeps fewer behind the point: 1000 or 1, nobody knows.
  static const QRegularExpression grouped(QStringLiteral("^[-+]?[1-9][0-9]{0,2}\\.[0-9]{3}$"));
  if (decimals() < 3 && grouped.match(*plain).hasMatch()) return {Reading::no_number};
  return {Reading::number, held};
}

QString NumberBox::problem() const {
  if (!specialValueText().isEmpty() && lineEdit()->text() == specialValueText()) return {};
  const QString typed = typed_in(lineEdit()->text());
  const Typed now = read(typed);
  const bool ended = typed == refused_;
  switch (now.reading) {
    case Reading::number:
    case Reading::unfinished:
      return {};
    case Reading::no_number:
      return tr("“%1” is no number. Digits are not grouped: 1234.5 or 1234,5").arg(typed);
    case Reading::too_fine:
      return decimals() == 0 ? tr("%1 is no whole number").arg(typed)
                             : tr("%1 has too many digits behind the point: %2 can be kept")
                                   .arg(typed, QString::number(decimals()));
    case Reading::out_of_range:
      if (!ended && can_become_larger_only(now.value)) return {};
      return tr("%1 is not within %2 to %3")
          .arg(typed, QDoubleSpinBox::textFromValue(minimum()), QDoubleSpinBox::textFromValue(maximum()));
  }
  return {};
}

QString NumberBox::textFromValue(double value) const {
  // Whatever sets the value that was there anyway leaves alone what was refused.
  const QString shown = typed_in(lineEdit()->text());
  if (!refused_.isEmpty() && shown == refused_ && value == kept_ && read(shown).reading != Reading::number)
    return shown;
  return QDoubleSpinBox::textFromValue(rounded(value, decimals()));
}

double NumberBox::valueFromText(const QString& text) const {
  const Typed typed = read(typed_in(text));
  return typed.reading == Reading::number ? typed.value : value();
}

QValidator::State NumberBox::validate(QString& text, int& /*position*/) const {
  return read(typed_in(text)).reading == Reading::number ? QValidator::Acceptable : QValidator::Intermediate;
}

// Qt asks for it when what was typed to the end cannot be taken.
void NumberBox::fixup(QString& text) const {
  refused_ = typed_in(text);
  kept_ = value();
  if (read(refused_).reading == Reading::unfinished) refused_.clear();
  if (!refused_.isEmpty() && isVisible())
    QToolTip::showText(mapToGlobal(rect().bottomLeft()), problem(), const_cast<NumberBox*>(this));
}

void NumberBox::keyPressEvent(QKeyEvent* event) {
  if (event->key() != Qt::Key_Escape || !is_being_typed()) return QDoubleSpinBox::keyPressEvent(event);
  show_value(value());
  selectAll();
}

bool NumberBox::event(QEvent* event) {
  if (event->type() == QEvent::ShortcutOverride && is_being_typed() &&
      static_cast<const QKeyEvent*>(event)->key() == Qt::Key_Escape) {
    event->accept();
    return true;
  }
  if (event->type() == QEvent::ShortcutOverride && !is_being_typed() &&
      is_letter(*static_cast<const QKeyEvent*>(event))) {
    event->ignore();
    return false;
  }
  if (event->type() != QEvent::ToolTip || problem().isEmpty()) return QDoubleSpinBox::event(event);
  QToolTip::showText(static_cast<QHelpEvent*>(event)->globalPos(), problem(), this);
  return true;
}

void NumberBox::paintEvent(QPaintEvent* event) {
  QDoubleSpinBox::paintEvent(event);
  const QString why = problem();
  if (why != accessibleDescription()) setAccessibleDescription(why);
  if (why.isEmpty()) return;
  QPainter painter(this);
  painter.setPen(QPen(problem_colour(palette()), 2.0));
  painter.drawRect(rect().adjusted(1, 1, -1, -1));
}

}  // namespace tidemark::ui
