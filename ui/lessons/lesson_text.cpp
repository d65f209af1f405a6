#include "ui/lessons/lesson_text.h"

#include <QCoreApplication>

#include "ui/widgets/number_text.h"

namespace tidemark::ui {
namespace {

QString text(std::string_view words) {
  return QString::fromUtf8(words.data(), static_cast<qsizetype>(words.size()));
}

}  // namespace

QString lesson_words(const std::string& words) {
  return QCoreApplication::translate("Lesson", words.c_str());
}

QString figure_title(std::string_view figure) {
  const document::LessonFigure* known = document::lesson_figure(figure);
  if (known == nullptr) return text(figure);
  return QCoreApplication::translate("tidemark::LessonFigure", std::string(known->title).c_str());
}

QString title_with_unit(const document::LessonFigure& figure) {
  const QString title = figure_title(figure.name);
  return figure.unit.empty() ? title : QStringLiteral("%1 (%2)").arg(title, text(figure.unit));
}

QString figure_text(const std::string& figure, double value) {
  const document::LessonFigure* known = document::lesson_figure(figure);
  if (known == nullptr) return number_text(value, 3);
  return number_text(value, known->digits, text(known->unit));
}

QString range_text(const document::LessonMeasure& measure) {
  const document::LessonFigure* known = document::lesson_figure(measure.figure);
  const QString high = figure_text(measure.figure, measure.high);
  if (measure.low == measure.high) return high;
  return QCoreApplication::translate("tidemark::LessonFigure", "%1 to %2")
      .arg(number_text(measure.low, known ? known->digits : 3), high);
}

}  // namespace tidemark::ui
