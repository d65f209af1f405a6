#include "ui/lessons/hand_in_box.h"

#include <QDate>
#include <QFileDialog>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QVBoxLayout>

#include "core/atomic_file.h"
#include "ui/lessons/answer_sheet.h"
#include "ui/lessons/lesson_text.h"
#include "ui/look/icons.h"
#include "ui/look/theme.h"
#include "ui/main/case_files.h"
#include "ui/results/file_name.h"
#include "ui/settings.h"
#include "ui/widgets/form.h"
#include "ui/widgets/path_text.h"
#include "ui/widgets/pdf_file.h"

namespace tidemark::ui {
namespace {

constexpr int kLongestStudentName = 100;

}  // namespace

HandInBox::HandInBox(engine::LessonCourse& course, QWidget* parent) : QWidget(parent), course_(course) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, kSpaceGroups, 0, 0);
  column->setSpacing(kSpace);
  auto* heading = new QLabel(tr("Hand in"));
  QFont bold = heading->font();
  bold.setBold(true);
  heading->setFont(bold);
  score_ = make_note({});
  name_ = new QLineEdit;
  name_->setMaxLength(kLongestStudentName);
  name_->setPlaceholderText(tr("Your name"));
  name_->setAccessibleName(tr("Your name"));
  name_->setToolTip(tr("Is written into the file that you choose, and kept nowhere else."));
  auto* row = new QHBoxLayout;
  row->setSpacing(kSpace);
  sheet_ = new QPushButton(icon(u"save"), tr("Save as PDF…"));
  table_ = new QPushButton(icon(u"save"), tr("Save as table…"));
  table_->setToolTip(tr("A CSV file, which spreadsheets open."));
  row->addWidget(sheet_);
  row->addWidget(table_);
  outcome_ = make_note({});
  outcome_->hide();
  column->addWidget(heading);
  column->addWidget(score_);
  column->addWidget(name_);
  column->addLayout(row);
  column->addWidget(outcome_);
  connect(sheet_, &QPushButton::clicked, this, [this] { ask(tr("PDF (*.pdf)"), ".pdf"); });
  connect(table_, &QPushButton::clicked, this, [this] { ask(tr("Table (*.csv)"), ".csv"); });
  connect(name_, &QLineEdit::textChanged, this, &HandInBox::follow);
  connect(&course_, &engine::LessonCourse::changed, this, &HandInBox::follow);
  connect(&jobs_, &engine::ResultJobs::written, this, [this] {
    course_.set_handed_in();
    say(tr("Wrote %1").arg(file_));
  });
  connect(&jobs_, &engine::ResultJobs::failed, this, &HandInBox::say);
  follow();
}

void HandInBox::say(const QString& sentence) {
  outcome_->setText(sentence);
  outcome_->show();
  follow();
  emit said();
}

void HandInBox::follow() {
  score_->setText(score_text());
  const bool named = !name_->text().trimmed().isEmpty();
  for (QPushButton* button : {sheet_, table_}) button->setEnabled(named && !jobs_.busy());
}

// Before all is done it would tell which predictions are right.
QString HandInBox::score_text() const {
  const std::size_t count = course_.lesson().parts.size();
  int done = 0;
  for (std::size_t i = 0; i < count; ++i) done += course_.done(i) ? 1 : 0;
  if (std::cmp_less(done, count)) return tr("%n of %1 parts are done.", nullptr, done).arg(count);
  const document::LessonScore score = document::score(course_.lesson(), course_.answers());
  return tr("%1 of %2 predictions right, %3 of %4 figures as expected.")
      .arg(score.right)
      .arg(score.questions)
      .arg(score.in_range)
      .arg(score.figures);
}

void HandInBox::ask(const QString& filter, const QString& suffix) {
  QFileDialog dialog(this, tr("Save the answers"), settings::save_folder().get(), filter);
  dialog.setAcceptMode(QFileDialog::AcceptSave);
  dialog.setDefaultSuffix(suffix.mid(1));
  // Answers of a course come together in a folder.
  const QString whose =
      lesson_words(course_.lesson().title) + QStringLiteral(" - ") + name_->text().trimmed();
  dialog.selectFile(file_name_of(whose) + suffix);
  if (dialog.exec() == QDialog::Accepted && !dialog.selectedFiles().isEmpty()) {
    const QString file = dialog.selectedFiles().constFirst();
    settings::save_folder().set(QFileInfo(file).absolutePath());
    write(file);
  }
}

void HandInBox::write(const QString& file) {
  file_ = file;
  document::LessonAnswers answers = course_.answers();
  answers.student = name_->text().trimmed().toStdString();
  answers.date = QDate::currentDate().toString(Qt::ISODate).toStdString();
  jobs_.write([lesson = course_.lesson(), answers, path = path_of(file)](const Progress&) -> Status {
    if (is_pdf_name(path)) return write_answer_sheet(lesson, answers, path);
    return write_file(path, document::to_csv(lesson, answers));
  });
  follow();
}

}  // namespace tidemark::ui
