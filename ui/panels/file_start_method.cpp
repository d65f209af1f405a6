#include "ui/panels/file_start_method.h"

#include <QFileDialog>
#include <QHBoxLayout>
#include <QLineEdit>
#include <QPointer>
#include <QPushButton>
#include <QToolButton>
#include <utility>

#include "core/without_exceptions.h"
#include "engine/background_job.h"
#include "engine/message_text.h"
#include "ui/look/icons.h"
#include "ui/look/theme.h"
#include "ui/panels/refine_choice.h"
#include "ui/widgets/file_patterns.h"
#include "ui/widgets/form.h"
#include "ui/widgets/number_text.h"
#include "ui/widgets/path_text.h"

namespace tidemark::ui {

FileStartMethod::FileStartMethod(StartFile kind, QWidget* parent) : StartMethod(parent), kind_(kind) {
  Form form(this);
  form.note(kind == StartFile::mask
                ? tr("Takes a mask of the same grid as the study: every voxel that is not 0 is inside.")
                : tr("Goes on with a level set that was saved as a volume of φ, on the grid of the study."));
  path_ = new QLineEdit;
  path_->setPlaceholderText(tr("No file chosen"));
  path_->setAccessibleName(tr("File"));
  path_->setToolTip(tr("The file's path."));
  path_->setClearButtonEnabled(true);
  auto* browse = new QToolButton;
  browse->setIcon(icon(u"open-file"));
  browse->setToolTip(tr("Choose a file"));
  browse->setAccessibleName(tr("Choose a file"));
  browse->setFocusPolicy(Qt::StrongFocus);
  auto* row = new QHBoxLayout;
  row->setSpacing(kSpaceTight);
  row->addWidget(path_, 1);
  row->addWidget(browse);
  cancel_ = new QPushButton(tr("Cancel"));
  cancel_->setToolTip(tr("Gives up reading the file."));
  cancel_->hide();
  row->addWidget(cancel_);
  form.wide(row);
  connect(browse, &QToolButton::clicked, this, &FileStartMethod::choose);
  connect(cancel_, &QPushButton::clicked, this, &FileStartMethod::cancel);
  connect(path_, &QLineEdit::textChanged, this, &StartMethod::changed);
  if (kind != StartFile::mask) return;
  refine_ = new RefineChoice;
  form.wide(refine_);
  connect(refine_, &RefineChoice::changed, this, &StartMethod::changed);
}

void FileStartMethod::Reading::give_up() {
  if (job) job->abandon();
  job.reset();
}

bool FileStartMethod::is_reading() const {
  const Reading* reading = readings_.find(proxy());
  return reading != nullptr && reading->job != nullptr;
}

QString FileStartMethod::title() const {
  return kind_ == StartFile::mask ? tr("Mask file") : tr("Saved level set");
}

QString FileStartMethod::sentence() const {
  if (is_reading()) return tr("Reading the file …");
  const QString name = QFileInfo(path_->text()).fileName();
  if (name.isEmpty()) return tr("Choose a file first.");
  if (const auto within_mm = refine_ ? refine_->within_mm() : std::nullopt) {
    return tr("Refines the mask in %1: the surface stays within %2 of it.")
        .arg(name, number_text(*within_mm, 1, tr("mm")));
  }
  return kind_ == StartFile::mask ? tr("Places the surface around the mask in %1.").arg(name)
                                  : tr("Goes on with the level set in %1.").arg(name);
}

bool FileStartMethod::can_start() const {
  return proxy() && !is_reading() && !path_->text().isEmpty();
}

void FileStartMethod::choose() {
  const QString filter =
      kind_ == StartFile::mask
          ? tr("Masks and segmentations (%1 *.dcm);;All files (*)").arg(QLatin1String(kVolumePatterns))
          : tr("Volumes (%1);;All files (*)").arg(QLatin1String(kVolumePatterns));
  auto* dialog =
      new QFileDialog(this, tr("Place surface from a file"), QFileInfo(path_->text()).path(), filter);
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setFileMode(QFileDialog::ExistingFile);
  connect(dialog, &QFileDialog::fileSelected, path_, &QLineEdit::setText);
  dialog->open();
}

void FileStartMethod::start(int levels) {
  const QPointer<engine::CaseProxy> wanted(proxy());
  const std::filesystem::path path = path_of(path_->text());
  StartRequest request{kind_,
                       path,
                       proxy()->volume().geometry,
                       proxy()->study().frame_of_reference_uid,
                       proxy()->state().band,
                       std::nullopt,
                       levels};
  if (refine_) request.within_mm = refine_->within_mm();
  readings_[*proxy()].job = engine::BackgroundJob::start(
      this,
      [this, wanted, request](engine::BackgroundJob& job) {
        const auto loaded = std::make_shared<Result<LoadedStart>>(without_exceptions([&] {
          return load_start(request, {nullptr, job.stop()});
        }));
        job.deliver([this, wanted, loaded] { take(*loaded, wanted); });
      },
      [this, wanted](const Error& error) { take(tl::unexpected<Error>(error), wanted); });
  show_reading();
  emit changed();
}

void FileStartMethod::cancel() {
  if (!proxy()) return;
  readings_[*proxy()].give_up();
  show_reading();
  emit changed();
}

void FileStartMethod::take(const Result<LoadedStart>& loaded, engine::CaseProxy* of) {
  if (!of) return;
  Reading& reading = readings_[*of];
  reading.job.reset();
  if (loaded) {
    of->begin(loaded->start);
    const QString remarks = engine::message_text(loaded->remarks);
    if (!remarks.isEmpty()) reading.remark = tr("%1: %2").arg(loaded->name, remarks);
  } else {
    reading.problem = engine::message_text(loaded.error());
  }
  if (of != proxy()) return;
  show_reading();
  emit changed();
}

void FileStartMethod::attach() {
  cancel_->hide();
}

void FileStartMethod::show_reading() {
  Reading& reading = readings_[*proxy()];
  cancel_->setVisible(reading.job != nullptr);
  if (const QString problem = std::exchange(reading.problem, {}); !problem.isEmpty()) emit failed(problem);
  if (const QString remark = std::exchange(reading.remark, {}); !remark.isEmpty()) emit remarked(remark);
}

}  // namespace tidemark::ui
