#include "ui/lessons/answer_sheet.h"

#include "ui/lessons/lesson_text.h"
#include "ui/widgets/pdf_file.h"
#include "ui/widgets/tr.h"

namespace tidemark::ui {
namespace {

QString html(const QString& text) {
  return text.toHtmlEscaped().replace(QChar('\n'), QStringLiteral("<br/>"));
}

QString row(const QString& name, const QString& value) {
  return QStringLiteral("<tr><td>%1</td><td>%2</td></tr>").arg(name, value);
}

QString question_rows(const document::LessonQuestion& question, const document::PartAnswers& given) {
  QString rows = row(tr("Question"), html(lesson_words(question.text)));
  const bool chosen = given.choice.has_value();
  const QString answer =
      html(chosen ? lesson_words(question.choices[*given.choice]) : QString::fromStdString(given.words));
  rows += row(tr("Answer"), answer.isEmpty() ? tr("none") : QStringLiteral("<b>%1</b>").arg(answer));
  if (question.right) {
    const bool right = given.choice == question.right;
    rows += row(QString(),
                right ? tr("right")
                      : tr("right would be: %1").arg(html(lesson_words(question.choices[*question.right]))));
  }
  return rows;
}

QString figure_rows(const document::LessonPart& part, const document::PartAnswers& given) {
  QString rows;
  for (std::size_t i = 0; i < part.measures.size(); ++i) {
    const document::LessonMeasure& measure = part.measures[i];
    const bool measured = i < given.figures.size() && given.figures[i].has_value();
    const QString value =
        measured ? figure_text(measure.figure, *given.figures[i]).toHtmlEscaped() : tr("not measured");
    const QString verdict = !measured                          ? QString()
                            : measure.holds(*given.figures[i]) ? tr("as expected")
                                                               : tr("not as expected");
    rows += row(figure_title(measure.figure).toHtmlEscaped(),
                QStringLiteral("<b>%1</b> (%2) %3")
                    .arg(value, tr("expected: %1").arg(range_text(measure).toHtmlEscaped()), verdict));
  }
  return rows;
}

QString page(const document::Lesson& lesson, const document::LessonAnswers& answers) {
  const document::LessonScore score = document::score(lesson, answers);
  QString text = QStringLiteral("<h1>%1</h1><p>%2</p><table cellpadding='3'>")
                     .arg(html(lesson_words(lesson.title)), html(lesson_words(lesson.about)));
  text += row(tr("Name"), html(QString::fromStdString(answers.student))) +
          row(tr("Date"), html(QString::fromStdString(answers.date)));
  text += row(tr("Right predictions"), tr("%1 of %2").arg(score.right).arg(score.questions));
  text += row(tr("Figures as expected"), tr("%1 of %2").arg(score.in_range).arg(score.figures));
  text += QStringLiteral("</table>");
  for (std::size_t i = 0; i < lesson.parts.size() && i < answers.parts.size(); ++i) {
    const document::LessonPart& part = lesson.parts[i];
    text += QStringLiteral("<h3>%1. %2</h3><table cellpadding='3'>")
                .arg(i + 1)
                .arg(html(lesson_words(part.title)));
    if (part.question) text += question_rows(*part.question, answers.parts[i]);
    text += figure_rows(part, answers.parts[i]) + QStringLiteral("</table>");
  }
  return text;
}

}  // namespace

Status write_answer_sheet(const document::Lesson& lesson, const document::LessonAnswers& answers,
                          const std::filesystem::path& file) {
  return write_pdf_file(page(lesson, answers), lesson_words(lesson.title), file);
}

}  // namespace tidemark::ui
