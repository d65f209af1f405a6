#include "ui/lessons/lesson_problem.h"

#include <QCoreApplication>
#include <QRegularExpression>
#include <QStringList>
#include <algorithm>
#include <utility>

namespace tidemark::ui {
namespace {

QString problem_text(const char* words) {
  return QCoreApplication::translate("LessonProblem", words);
}

// Fields of lesson files, as the form names them.
constexpr std::pair<const char*, const char*> kFields[] = {
    {"title", QT_TRANSLATE_NOOP("LessonProblem", "title")},
    {"text", QT_TRANSLATE_NOOP("LessonProblem", "text")},
    {"about", QT_TRANSLATE_NOOP("LessonProblem", "about")},
    {"author", QT_TRANSLATE_NOOP("LessonProblem", "author")},
    {"minutes", QT_TRANSLATE_NOOP("LessonProblem", "time needed")},
    {"study", QT_TRANSLATE_NOOP("LessonProblem", "study")},
    {"phantom", QT_TRANSLATE_NOOP("LessonProblem", "phantom")},
    {"file", QT_TRANSLATE_NOOP("LessonProblem", "file")},
    {"start", QT_TRANSLATE_NOOP("LessonProblem", "start")},
    {"parameters", QT_TRANSLATE_NOOP("LessonProblem", "parameters")},
    {"parts", QT_TRANSLATE_NOOP("LessonProblem", "parts")},
    {"question", QT_TRANSLATE_NOOP("LessonProblem", "question")},
    {"choices", QT_TRANSLATE_NOOP("LessonProblem", "choices")},
    {"right", QT_TRANSLATE_NOOP("LessonProblem", "right choice")},
    {"try", QT_TRANSLATE_NOOP("LessonProblem", "try")},
    {"goes_on", QT_TRANSLATE_NOOP("LessonProblem", "begins")},
    {"smoothed_mm", QT_TRANSLATE_NOOP("LessonProblem", "smoothing")},
    {"steps", QT_TRANSLATE_NOOP("LessonProblem", "steps")},
    {"show", QT_TRANSLATE_NOOP("LessonProblem", "shows")},
    {"measure", QT_TRANSLATE_NOOP("LessonProblem", "figures")},
    {"low", QT_TRANSLATE_NOOP("LessonProblem", "from")},
    {"high", QT_TRANSLATE_NOOP("LessonProblem", "to")},
    {"explanation", QT_TRANSLATE_NOOP("LessonProblem", "explanation")},
    {"target", QT_TRANSLATE_NOOP("LessonProblem", "target T")},
    {"range", QT_TRANSLATE_NOOP("LessonProblem", "range ε")},
    {"alpha", QT_TRANSLATE_NOOP("LessonProblem", "data weight α")},
};

QString field_text(const QString& field) {
  for (const auto& [name, words] : kFields) {
    if (field == QLatin1String(name)) return problem_text(words);
  }
  return field;
}

// "measure[1].high" as "figures 2, to".
QStringList place_text(const QString& place) {
  static const QRegularExpression kIndexed(QStringLiteral("^(.+)\\[(\\d+)\\]$"));
  QStringList words;
  for (const QString& step : place.split(u'.', Qt::SkipEmptyParts)) {
    const auto indexed = kIndexed.match(step);
    words << (indexed.hasMatch() ? QStringLiteral("%1 %2")
                                       .arg(field_text(indexed.captured(1)))
                                       .arg(indexed.captured(2).toInt() + 1)
                                 : field_text(step));
  }
  return words;
}

QString part_text(const document::Lesson& lesson, std::size_t part) {
  const QString title =
      part < lesson.parts.size() ? QString::fromStdString(lesson.parts[part].title) : QString();
  const QString number = problem_text(QT_TRANSLATE_NOOP("LessonProblem", "Part %1")).arg(part + 1);
  return title.trimmed().isEmpty() ? number : QStringLiteral("%1 “%2”").arg(number, title);
}

}  // namespace

LessonProblem in_words(const std::string& message, const document::Lesson& lesson) {
  static const QRegularExpression kPlace(
      QStringLiteral("^([a-z_]+(?:\\[\\d+\\])?(?:\\.[a-z_]+(?:\\[\\d+\\])?)*): "));
  static const QRegularExpression kPart(QStringLiteral("^parts\\[(\\d+)\\]"));
  const QString whole = QString::fromStdString(message);
  const auto place = kPlace.match(whole);
  if (!place.hasMatch()) return {whole, {}};
  LessonProblem problem;
  QString field = place.captured(1);
  QStringList words;
  if (const auto part = kPart.match(field); part.hasMatch()) {
    problem.part = part.captured(1).toULongLong();
    words << part_text(lesson, *problem.part);
    field.remove(0, part.capturedLength());
  } else {
    words << problem_text(QT_TRANSLATE_NOOP("LessonProblem", "Lesson"));
  }
  words << place_text(field);
  problem.sentence =
      QStringLiteral("%1: %2").arg(words.join(QStringLiteral(", ")), whole.mid(place.capturedLength()));
  return problem;
}

std::optional<LessonProblem> problem_of(const document::Lesson& lesson) {
  return problem_of(lesson, lesson);
}

std::optional<LessonProblem> problem_of(const document::Lesson& lesson, const document::Lesson& titled) {
  // The file's own words on it name the largest number there is.
  for (std::size_t i = 0; i < lesson.parts.size(); ++i) {
    const auto& measures = lesson.parts[i].measures;
    const auto turned = std::find_if(measures.begin(), measures.end(),
                                     [](const document::LessonMeasure& one) { return one.low > one.high; });
    if (turned == measures.end()) continue;
    return LessonProblem{
        problem_text(
            QT_TRANSLATE_NOOP("LessonProblem", "%1, figure %2: the range ends below where it begins"))
            .arg(part_text(titled, i), QString::number(turned - measures.begin() + 1)),
        i};
  }
  const auto written = lesson.to_text();
  if (written) return std::nullopt;
  return in_words(written.error().message, titled);
}

}  // namespace tidemark::ui
