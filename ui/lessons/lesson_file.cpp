#include "ui/lessons/lesson_file.h"

#include <QFileDialog>
#include <QFileInfo>
#include <utility>

#include "core/atomic_file.h"
#include "engine/message_text.h"
#include "ui/settings.h"
#include "ui/widgets/path_text.h"
#include "ui/widgets/question.h"

namespace tidemark::ui {
namespace {

QString filter() {
  return LessonFile::tr("Lessons (*.json)");
}

// For names of files: a title without what has no place in them.
QString file_name(const std::string& title) {
  QString name = QString::fromStdString(title).simplified();
  for (QChar& letter : name) {
    if (QStringLiteral("/\\:*?\"<>|").contains(letter)) letter = u'-';
  }
  return (name.isEmpty() ? LessonFile::tr("lesson") : name) + QStringLiteral(".json");
}

}  // namespace

LessonFile::LessonFile(QWidget& window, std::function<const document::Lesson&()> lesson,
                       std::function<QString()> problem)
    : QObject(&window),
      window_(window),
      lesson_(std::move(lesson)),
      problem_(std::move(problem)),
      writing_(this) {
  connect(&reading_, &engine::LessonJobs::loaded, this, [this](const auto& loaded) {
    emit said({});
    emit opened(*loaded, read_);
  });
  connect(&reading_, &engine::LessonJobs::failed, this, &LessonFile::said);
}

void LessonFile::begin(const std::filesystem::path& file) {
  reading_.cancel();
  path_ = file;
  first_edits_ = saved_edits_ = ++edits_;
}

void LessonFile::ask_and_open() {
  when_kept([this] {
    const QString begin_in = path_.empty() ? settings::open_folder().get() : text_of(folder());
    auto* dialog = new QFileDialog(&window_, tr("Open a lesson"), begin_in, filter());
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setFileMode(QFileDialog::ExistingFile);
    connect(dialog, &QFileDialog::fileSelected, this, [this](const QString& file) { open(path_of(file)); });
    dialog->open();
  });
}

void LessonFile::open(const std::filesystem::path& file) {
  read_ = file;
  reading_.load(file);
}

void LessonFile::save() {
  if (path_.empty()) return save_as();
  write(path_);
}

void LessonFile::save_as() {
  if (const QString problem = problem_(); !problem.isEmpty()) {
    after_saving_ = {};
    return emit said(tr("Not saved. %1").arg(problem));
  }
  const QString begin_in = path_.empty() ? settings::save_folder().get() : text_of(folder());
  auto* dialog = new QFileDialog(&window_, tr("Save the lesson"), begin_in, filter());
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setAcceptMode(QFileDialog::AcceptSave);
  dialog->setOption(QFileDialog::DontConfirmOverwrite);  // asked about the name with its suffix
  dialog->selectFile(path_.empty() ? file_name(lesson_().title) : text_of(path_.filename()));
  connect(dialog, &QDialog::rejected, this, [this] { after_saving_ = {}; });
  connect(dialog, &QFileDialog::fileSelected, this, [this](QString file) {
    const QString suffix = QStringLiteral(".json");
    if (!file.endsWith(suffix, Qt::CaseInsensitive)) file += suffix;
    if (QFileInfo::exists(file) &&
        ask(&window_, tr("Save the lesson"), tr("%1 exists. Replace it?").arg(file),
            QMessageBox::Yes | QMessageBox::No, QMessageBox::No) != QMessageBox::Yes) {
      after_saving_ = {};
      return;
    }
    settings::save_folder().set(QFileInfo(file).absolutePath());
    write(path_of(file));
  });
  dialog->open();
}

void LessonFile::write(const std::filesystem::path& file) {
  if (const QString problem = problem_(); !problem.isEmpty()) {
    after_saving_ = {};
    return emit said(tr("Not saved. %1").arg(problem));
  }
  writing_.add(
      [lesson = lesson_(), file](const Progress&) -> Status {
        const auto text = lesson.to_text();
        if (!text) return pass_on(text);
        return write_file(file, *text);
      },
      [this, file, edits = edits_, next = std::exchange(after_saving_, {})](const Status& done) {
        if (!done) return emit said(engine::message_text(done.error()));
        note_written(file, edits, next);
      });
}

// Of a lesson that is edited no more, nothing but the file is left.
void LessonFile::note_written(const std::filesystem::path& file, std::uint64_t edits,
                              const std::function<void()>& next) {
  const bool is_present = edits >= first_edits_;
  if (is_present) {
    path_ = file;
    saved_edits_ = edits;
  }
  emit said(tr("Wrote %1").arg(text_of(file)));
  emit saved(text_of(file));
  if (is_present && next) next();
}

void LessonFile::when_kept(std::function<void()> next) {
  if (!is_modified()) return next();
  const QString title = QString::fromStdString(lesson_().title);
  const auto answer = ask(
      &window_, tr("Lesson"),
      title.isEmpty() ? tr("Save the changes of the lesson?") : tr("Save the changes of “%1”?").arg(title),
      QMessageBox::Save | QMessageBox::Discard | QMessageBox::Cancel, QMessageBox::Save);
  if (answer == QMessageBox::Discard) {
    saved_edits_ = edits_;
    return next();
  }
  if (answer != QMessageBox::Save) return;
  after_saving_ = std::move(next);
  save();
}

}  // namespace tidemark::ui
