#include "ui/main/saved_cases.h"

#include <QCloseEvent>
#include <QFileDialog>
#include <QFileInfo>
#include <QMessageBox>
#include <QPushButton>
#include <QSettings>
#include <QStatusBar>
#include <filesystem>

#include "imaging/files/png_file.h"
#include "imaging/files/volume_file.h"
#include "imaging/surface/surface.h"
#include "session/background_job.h"
#include "ui/main/main_window.h"
#include "ui/main/panel_docks.h"
#include "ui/panels/statistics_panel.h"
#include "ui/views/picture_view.h"

namespace tidemark {
namespace {

std::filesystem::path path_of(const QString& file) { return file.toStdU16String(); }

Status write_label_file(const Labels& labels, const std::filesystem::path& file) {
  Volume volume;
  volume.geometry = labels.geometry();
  volume.voxels = std::vector<std::uint16_t>(labels.voxels().begin(), labels.voxels().end());
  return write_volume_file(volume, file);
}

}  // namespace

SavedCases::SavedCases(MainWindow& window) : QObject(&window), window_(window) {}

SavedCases::~SavedCases() {
  for (const auto& job : jobs_) job->abandon();
}

void SavedCases::run(const QString& file, std::function<Status()> work) {
  jobs_.push_back(BackgroundJob::start(this, [this, file, work = std::move(work)](BackgroundJob& job) {
    const Status status = work();
    job.deliver([this, file, status] {
      if (!status) return window_.tell(QString::fromStdString(status.error().message));
      window_.statusBar()->showMessage(tr("Wrote %1").arg(file), 8000);
      emit written(file);
    });
  }));
}

void SavedCases::write(CaseWindow& window, const QString& file, Write work) {
  window.session().take_snapshot([this, file, work = std::move(work)](const std::shared_ptr<const CaseSnapshot>& snapshot) {
    run(file, [snapshot, work] { return work(*snapshot); });
  });
}

QString SavedCases::ask_for_file(const CaseWindow& window, const QString& title, const QString& suffixes,
                                 const QString& suffix) {
  QFileDialog dialog(&window_, title, QSettings().value("save/folder").toString(), suffixes);
  dialog.setAcceptMode(QFileDialog::AcceptSave);
  dialog.setDefaultSuffix(suffix);
  dialog.selectFile(window.windowTitle().remove(QStringLiteral("[*]")).simplified().replace('/', '-'));
  if (dialog.exec() != QDialog::Accepted || dialog.selectedFiles().isEmpty()) return {};
  const QString file = dialog.selectedFiles().first();
  QSettings().setValue("save/folder", QFileInfo(file).absolutePath());
  return file;
}

// Exports.

void SavedCases::export_mask(CaseWindow& window) {
  const bool has_labels = !window.session().state().labels.empty();
  QString what = tr("surface");
  if (has_labels) {
    QMessageBox box(QMessageBox::Question, tr("Export"), tr("What is to be written?"), QMessageBox::Cancel, &window_);
    QAbstractButton* surface = box.addButton(tr("Inside of the surface"), QMessageBox::AcceptRole);
    box.addButton(tr("All labels"), QMessageBox::AcceptRole);
    box.exec();
    if (box.clickedButton() == box.button(QMessageBox::Cancel)) return;
    if (box.clickedButton() != surface) what = tr("labels");
  }
  const QString file = ask_for_file(window, tr("Export %1").arg(what),
                                    tr("NIfTI (*.nii.gz *.nii);;NRRD (*.nrrd);;MetaImage (*.mha)"), "nii.gz");
  if (file.isEmpty()) return;
  what == tr("labels") ? write_labels(window, file) : write_mask(window, file);
}

void SavedCases::write_mask(CaseWindow& window, const QString& file) {
  write(window, file, [path = path_of(file)](const CaseSnapshot& snapshot) {
    return write_mask_file(snapshot.phi->mask(), path);
  });
}

void SavedCases::write_labels(CaseWindow& window, const QString& file) {
  write(window, file,
        [path = path_of(file)](const CaseSnapshot& snapshot) { return write_label_file(snapshot.labels, path); });
}

void SavedCases::export_mesh(CaseWindow& window) {
  const QString file = ask_for_file(window, tr("Export the surface"),
                                    tr("STL (*.stl);;PLY (*.ply);;Wavefront OBJ (*.obj)"), "stl");
  if (!file.isEmpty()) write_surface(window, file);
}

void SavedCases::write_surface(CaseWindow& window, const QString& file) {
  write(window, file, [path = path_of(file)](const CaseSnapshot& snapshot) -> Status {
    const auto mesh = extract_surface(snapshot.phi->to_volume());
    if (!mesh) return tl::unexpected<Error>(mesh.error());
    return write_mesh(*mesh, path);
  });
}

void SavedCases::export_picture(CaseWindow& window) {
  const QString file = ask_for_file(window, tr("Export the picture"), tr("PNG (*.png)"), "png");
  if (!file.isEmpty()) write_picture(window, file);
}

void SavedCases::write_picture(CaseWindow& window, const QString& file) {
  PictureView* view = window.active_view();
  if (!view) return;
  // Nothing that tells who the patient is.
  Display& display = window.session().display();
  const bool text = display.settings().patient_text;
  display.change([](DisplaySettings& settings) { settings.patient_text = false; });
  const QImage image = view->grab_picture().convertToFormat(QImage::Format_RGBA8888);
  display.change([text](DisplaySettings& settings) { settings.patient_text = text; });
  run(file, [image, path = path_of(file)] {
    return write_png_file(image.width(), image.height(),
                          std::span(image.constBits(), static_cast<std::size_t>(image.sizeInBytes())), path);
  });
}

void SavedCases::export_statistics(CaseWindow& window) {
  const QString file = ask_for_file(window, tr("Export statistics"), tr("Table (*.csv)"), "csv");
  if (!file.isEmpty()) window_.panels().statistics().export_csv(path_of(file));
}

void SavedCases::export_recipe(CaseWindow& /*window*/) {}
void SavedCases::save(CaseWindow& /*window*/) {}
void SavedCases::save_as(CaseWindow& /*window*/) {}
void SavedCases::ask_and_open() {}
void SavedCases::open(const QString& /*file*/) {}

void SavedCases::close(QCloseEvent* event) {
  auto* window = qobject_cast<CaseWindow*>(sender());
  if (!window || !window->session().state().modified) return event->accept();
  const auto answer =
      QMessageBox::question(&window_, tr("Close"),
                            tr("%1 has changes that are not in a session file. Close it all the same?")
                                .arg(window->session().name()),
                            QMessageBox::Save | QMessageBox::Discard | QMessageBox::Cancel, QMessageBox::Save);
  if (answer == QMessageBox::Save) save(*window);
  event->setAccepted(answer == QMessageBox::Discard);
}

}  // namespace tidemark
