#include "ui/results/write_result_dialog.h"

#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QMessageBox>
#include <algorithm>
#include <utility>

#include "document/segment_meshes.h"
#include "imaging/audit/event.h"
#include "ui/look/icons.h"
#include "ui/look/theme.h"
#include "ui/results/file_name.h"
#include "ui/settings.h"
#include "ui/widgets/path_text.h"

namespace tidemark::ui {
namespace {

QString usual_folder() {
  const QString folder = settings::save_folder().get();
  return QFileInfo::exists(folder) ? folder : QDir::homePath();
}

QString title_of(ResultFile kind) {
  switch (kind) {
    case ResultFile::segmentation:
      return WriteResultDialog::tr("Export a DICOM segmentation");
    case ResultFile::structure_set:
      return WriteResultDialog::tr("Export an RT structure set");
    case ResultFile::meshes:
      return WriteResultDialog::tr("Export labels as polygons");
    case ResultFile::level_set:
      break;
  }
  return WriteResultDialog::tr("Export the level set");
}

QString note_of(ResultFile kind, const engine::LoadedStudy& study) {
  switch (kind) {
    case ResultFile::level_set:
      return WriteResultDialog::tr(
          "For programs that use OpenVDB: the distance to the surface near it, negative inside, in mm of the "
          "patient (LPS).");
    case ResultFile::meshes:
      return WriteResultDialog::tr(
          "A file for each label (STL, PLY or OBJ, in mm of the patient, LPS). Its name ends in the label's: "
          "\"study-Liver.stl\".");
    case ResultFile::segmentation:
    case ResultFile::structure_set:
      break;
  }
  return source_note(study);
}

Status write_kind(const document::SessionContents& contents, ResultFile kind, document::ResultContent content,
                  const std::vector<std::filesystem::path>& source, const std::filesystem::path& file,
                  const Progress& progress) {
  if (kind == ResultFile::level_set) {
    progress(0.0, "writing the level set");
    return imaging::write_level_set(contents.phi->to_volume(), contents.phi->band, file);
  }
  const auto segments = document::result_segments(contents, content);
  if (!segments) return pass_on(segments);
  if (kind == ResultFile::meshes) return document::write_meshes(*segments, file, progress);
  const auto form = kind == ResultFile::segmentation ? imaging::ResultForm::segmentation
                                                     : imaging::ResultForm::structure_set;
  return document::write_result(*segments, form, source, file, progress);
}

}  // namespace

WriteResultDialog::WriteResultDialog(CaseWindow& window, ResultFile kind)
    : ResultDialog(window, title_of(kind)), kind_(kind), file_(new QLineEdit(this)) {
  build(kind != ResultFile::level_set, make_target(), note_of(kind, proxy().study()), tr("&Write"),
        tr("Writes what the case is like now"));
  connect(file_, &QLineEdit::textChanged, this, &WriteResultDialog::follow);
  connect(&jobs_, &engine::ResultJobs::progressed, &work(), &WorkLine::set_progress);
  connect(&jobs_, &engine::ResultJobs::failed, this, &WriteResultDialog::rest);
  connect(&jobs_, &engine::ResultJobs::cancelled, this,
          [this] { rest(tr("Cancelled: nothing was written.")); });
  connect(&jobs_, &engine::ResultJobs::written, this, [this] {
    const QString written_files = files().join(QStringLiteral(", "));
    rest(tr("Wrote %1").arg(written_files));
    emit written(written_files);
    accept();
  });
  file_->setText(usual_file());
}

QWidget* WriteResultDialog::make_target() {
  auto* target = new QWidget(this);
  auto* row = new QHBoxLayout(target);
  row->setContentsMargins(0, 0, 0, 0);
  auto* label = new QLabel(tr("&File"), target);
  label->setBuddy(file_);
  file_->setAccessibleName(tr("File"));
  file_->setToolTip(tr("Where to. The file appears whole or not at all."));
  auto* choose = new QPushButton(icon(u"open-folder"), tr("&Choose…"), target);
  choose->setAutoDefault(false);
  choose->setToolTip(tr("Choose folder and name"));
  connect(choose, &QPushButton::clicked, this, &WriteResultDialog::choose);
  row->addWidget(label);
  row->addWidget(file_, 1);
  row->addWidget(choose);
  return target;
}

QStringList WriteResultDialog::suffixes() const {
  if (kind_ == ResultFile::meshes)
    return {QStringLiteral(".stl"), QStringLiteral(".ply"), QStringLiteral(".obj")};
  return {kind_ == ResultFile::level_set ? QStringLiteral(".vdb") : QStringLiteral(".dcm")};
}

QStringList WriteResultDialog::files() const {
  if (kind_ != ResultFile::meshes) return {file_->text()};
  std::vector<std::string> names;
  if (content() == document::ResultContent::surface)
    names = {document::kSurfaceSegment};
  else
    for (const document::Label& label : proxy().state().labels) {
      if (label.visible || content() == document::ResultContent::all_labels) names.push_back(label.name);
    }
  QStringList files;
  for (const std::filesystem::path& file : document::mesh_files(names, path_of(file_->text()))) {
    files << text_of(file);
  }
  return files;
}

QString WriteResultDialog::usual_file() const {
  const QString what = kind_ == ResultFile::segmentation    ? tr("segmentation")
                       : kind_ == ResultFile::structure_set ? tr("contours")
                       : kind_ == ResultFile::meshes        ? QString()
                                                            : tr("level set");
  const QString name = file_name_of(proxy().study());
  return QDir(usual_folder())
      .filePath(QStringLiteral("%1 %2").arg(name, what).trimmed() + suffixes().first());
}

void WriteResultDialog::choose() {
  const QString filters = kind_ == ResultFile::level_set ? tr("OpenVDB (*.vdb)")
                          : kind_ == ResultFile::meshes
                              ? tr("STL (*.stl);;PLY (*.ply);;Wavefront OBJ (*.obj)")
                              : tr("DICOM (*.dcm)");
  auto* dialog = new QFileDialog(this, windowTitle(), QFileInfo(file_->text()).path(), filters);
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setAcceptMode(QFileDialog::AcceptSave);
  dialog->setOption(QFileDialog::DontConfirmOverwrite);  // asked at the end
  dialog->selectFile(QFileInfo(file_->text()).fileName());
  connect(dialog, &QFileDialog::fileSelected, file_, &QLineEdit::setText);
  dialog->open();
}

// The question goes with its case, which may close while it is open.
void WriteResultDialog::confirm(std::function<void()> go_on) {
  QString file = QDir(usual_folder()).absoluteFilePath(file_->text().trimmed());
  const QStringList endings = suffixes();
  const bool ends = std::any_of(endings.begin(), endings.end(), [&](const QString& ending) {
    return file.endsWith(ending, Qt::CaseInsensitive);
  });
  if (!ends) file += endings.first();
  file_->setText(file);
  if (is_of_study(proxy().study(), path_of(file))) {
    return rest(tr("%1 is a file of the study, which is never written to: choose another name.").arg(file));
  }
  QStringList there = files();
  there.removeIf([](const QString& one) { return !QFileInfo::exists(one); });
  if (there.isEmpty()) return go_on();
  const QString question = there.size() == 1 ? tr("%1 exists. Replace it?").arg(there.first())
                                             : tr("%1 and %n more exist. Replace them?", nullptr,
                                                  static_cast<int>(there.size() - 1))
                                                   .arg(there.first());
  auto* box = new QMessageBox(QMessageBox::Question, windowTitle(), question,
                              QMessageBox::Yes | QMessageBox::No, this);
  box->setAttribute(Qt::WA_DeleteOnClose);
  box->setTextFormat(Qt::PlainText);
  box->setDefaultButton(QMessageBox::No);
  connect(box, &QMessageBox::finished, this, [go_on = std::move(go_on)](int answer) {
    if (answer == QMessageBox::Yes) go_on();
  });
  box->open();
}

void WriteResultDialog::begin(const Snapshot& snapshot) {
  settings::save_folder().set(QFileInfo(file_->text()).absolutePath());
  std::vector<std::filesystem::path> written_files;
  for (const QString& file : files()) written_files.push_back(path_of(file));
  jobs_.write([snapshot, kind = kind_, what = content(), study = proxy().shared_study(),
               file = path_of(file_->text()), written_files](const Progress& progress) {
    return imaging::exported(write_kind(snapshot->contents, kind, what, study->dicom_files, file, progress),
                             study->audited, written_files);
  });
}

}  // namespace tidemark::ui
