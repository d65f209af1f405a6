#include "ui/main/saved_cases.h"

#include <QCloseEvent>
#include <QFileDialog>
#include <QFileInfo>
#include <QMessageBox>
#include <QPushButton>
#include <QRegularExpression>
#include <QSettings>
#include <QStatusBar>
#include <filesystem>

#include "core/atomic_file.h"
#include "core/without_exceptions.h"
#include "document/session_file.h"
#include "engine/background_job.h"
#include "engine/case_autosave.h"
#include "imaging/files/png_file.h"
#include "imaging/files/volume_file.h"
#include "imaging/surface/surface.h"
#include "ui/main/main_window.h"
#include "ui/main/message_bar.h"
#include "ui/main/rescue_dialog.h"
#include "ui/panels/region_table.h"
#include "ui/views/picture_view.h"

namespace tidemark {
namespace {

std::filesystem::path path_of(const QString& file) {
  return file.toStdU16String();
}

Status write_label_file(const SessionContents& contents, const std::filesystem::path& file) {
  Volume volume;
  volume.geometry = contents.geometry;
  std::vector<std::uint16_t> voxels(static_cast<std::size_t>(contents.geometry.voxel_count()));
  if (contents.label_voxels)
    std::copy(contents.label_voxels->begin(), contents.label_voxels->end(), voxels.begin());
  volume.voxels = std::move(voxels);
  return write_volume_file(volume, file);
}

const char* const kSessionSuffix = "tidemark";

// A name that has none of the endings of a filter ("NIfTI (*.nii.gz *.nii)") gets the first: the suffix says
// which format is written, and a name may have dots of its own.
QString with_suffix(const QString& file, const QString& filter) {
  static const QRegularExpression kEnding(QStringLiteral("\\*(\\.[\\w.]+)"));
  QString first;
  for (auto endings = kEnding.globalMatch(filter); endings.hasNext();) {
    const QString ending = endings.next().captured(1);
    if (file.endsWith(ending, Qt::CaseInsensitive)) return file;
    if (first.isEmpty()) first = ending;
  }
  return file + first;
}

// For messages: the same case to a file of the same kind.
QString about_writing(const CaseWindow& window, const QString& file) {
  return QStringLiteral("%1 of %2").arg(QFileInfo(file).suffix()).arg(reinterpret_cast<quintptr>(&window));
}

// What programs left behind that died; nothing where there is no memory even for that.
std::vector<Recoverable> find_copies() {
  auto found = without_exceptions([]() -> Result<std::vector<Recoverable>> {
    sweep_unfinished(recovery_folder());
    return find_recoverable(recovery_folder());
  });
  return found ? std::move(*found) : std::vector<Recoverable>();
}

}  // namespace

SavedCases::SavedCases(MainWindow& window) : QObject(&window), window_(window) {
  connect(&loader_, &StudyLoader::loaded, this, &SavedCases::compare);
  connect(&loader_, &StudyLoader::failed, this, [this](const QString& message) {
    end_reading(tr("The study of the session %1 was not found: %2").arg(waiting_.front().file, message));
  });
}

SavedCases::~SavedCases() {
  for (const auto& job : jobs_) job->abandon();
}

void SavedCases::run(const QString& about, const QString& file, std::function<Status()> work,
                     std::function<void()> done) {
  jobs_.push_back(BackgroundJob::start(this, [this, about, file, work = std::move(work), done](auto& job) {
    const Status status = without_exceptions(work);
    job.deliver([this, about, file, status, done] {
      if (!status) return window_.tell(QString::fromStdString(status.error().message), about);
      window_.settle(about);
      window_.statusBar()->showMessage(tr("Wrote %1").arg(file), 8000);
      if (done) done();
      emit written(file);
    });
  }));
}

void SavedCases::write(CaseWindow& window, const QString& file, Write work) {
  window.proxy().take_snapshot(window.view_state(), [this, about = about_writing(window, file), file,
                                                     work = std::move(work)](const auto& snapshot) {
    run(about, file, [snapshot, work] { return work(snapshot->contents); });
  });
}

QString SavedCases::ask_for_file(const CaseWindow& window, const QString& title, const QString& suffixes) {
  const QPointer alive(&window);
  QFileDialog dialog(&window_, title, QSettings().value("save/folder").toString(), suffixes);
  dialog.setAcceptMode(QFileDialog::AcceptSave);
  dialog.selectFile(window.windowTitle().remove(QStringLiteral("[*]")).simplified().replace('/', '-'));
  if (dialog.exec() != QDialog::Accepted || dialog.selectedFiles().isEmpty()) return {};
  const QString named = dialog.selectedFiles().first();
  const QString file = with_suffix(named, dialog.selectedNameFilter());
  // The dialog has asked about the name as it was typed.
  if (file != named && QFileInfo::exists(file) &&
      QMessageBox::question(&window_, title, tr("%1 exists. Replace it?").arg(file),
                            QMessageBox::Yes | QMessageBox::No, QMessageBox::No) != QMessageBox::Yes) {
    return {};
  }
  if (!alive) return {};
  QSettings().setValue("save/folder", QFileInfo(file).absolutePath());
  return file;
}

// Exports.

void SavedCases::export_mask(CaseWindow& window) {
  const bool has_labels = !window.proxy().state().labels.empty();
  QString what = tr("mask");
  if (has_labels) {
    QMessageBox box(QMessageBox::Question, tr("Export"), tr("What is to be written?"), QMessageBox::Cancel,
                    &window_);
    QAbstractButton* surface = box.addButton(tr("Inside of the surface"), QMessageBox::AcceptRole);
    QAbstractButton* labels = box.addButton(tr("All labels"), QMessageBox::AcceptRole);
    const QPointer alive(&window);
    box.exec();
    if (!alive || (box.clickedButton() != surface && box.clickedButton() != labels)) return;
    if (box.clickedButton() == labels) what = tr("labels");
  }
  const QString file = ask_for_file(window, tr("Export %1").arg(what),
                                    tr("NIfTI (*.nii.gz *.nii);;NRRD (*.nrrd);;MetaImage (*.mha)"));
  if (file.isEmpty()) return;
  what == tr("labels") ? write_labels(window, file) : write_mask(window, file);
}

void SavedCases::write_mask(CaseWindow& window, const QString& file) {
  write(window, file, [path = path_of(file)](const SessionContents& contents) {
    return write_mask_file(contents.phi->mask(), path);
  });
}

void SavedCases::write_labels(CaseWindow& window, const QString& file) {
  write(window, file,
        [path = path_of(file)](const SessionContents& contents) { return write_label_file(contents, path); });
}

void SavedCases::export_mesh(CaseWindow& window) {
  const QString file =
      ask_for_file(window, tr("Export the surface"), tr("STL (*.stl);;PLY (*.ply);;Wavefront OBJ (*.obj)"));
  if (!file.isEmpty()) write_surface(window, file);
}

void SavedCases::write_surface(CaseWindow& window, const QString& file) {
  write(window, file, [path = path_of(file)](const SessionContents& contents) -> Status {
    const auto mesh = extract_surface(contents.phi->to_volume());
    if (!mesh) return tl::unexpected<Error>(mesh.error());
    return write_mesh(*mesh, path);
  });
}

void SavedCases::export_picture(CaseWindow& window) {
  const QString file = ask_for_file(window, tr("Export the picture"), tr("PNG (*.png)"));
  if (!file.isEmpty()) write_picture(window, file);
}

void SavedCases::write_picture(CaseWindow& window, const QString& file) {
  PictureView* view = window.active_view();
  if (!view) return;
  // Nothing that tells who the patient is.
  Display& display = window.proxy().display();
  const bool text = display.settings().patient_text;
  display.change([](DisplaySettings& settings) { settings.patient_text = false; });
  const QImage image = view->grab_picture().convertToFormat(QImage::Format_RGBA8888);
  display.change([text](DisplaySettings& settings) { settings.patient_text = text; });
  run(about_writing(window, file), file, [image, path = path_of(file)] {
    return write_png_file(image.width(), image.height(),
                          std::span(image.constBits(), static_cast<std::size_t>(image.sizeInBytes())), path);
  });
}

void SavedCases::export_statistics(CaseWindow& window) {
  const QString file = ask_for_file(window, tr("Export statistics"), tr("Table (*.csv)"));
  if (!file.isEmpty()) write_statistics(window, file);
}

void SavedCases::write_statistics(CaseWindow& window, const QString& file) {
  run(about_writing(window, file), file,
      [csv = to_csv(window.proxy()), path = path_of(file)] { return write_file(path, csv); });
}

void SavedCases::export_recipe(CaseWindow& window) {
  const QString file = ask_for_file(window, tr("Export the recipe"), tr("Recipe (*.json)"));
  if (file.isEmpty()) return;
  write(window, file, [path = path_of(file)](const SessionContents& contents) -> Status {
    const auto text = contents.recipe.to_text();
    if (!text) return tl::unexpected<Error>(text.error());
    return write_file(path, *text);
  });
}

// Sessions.

void SavedCases::save(CaseWindow& window) {
  window.session_file.isEmpty() ? save_as(window) : save_to(window, window.session_file);
}

void SavedCases::save_as(CaseWindow& window) {
  const QString file =
      ask_for_file(window, tr("Save the session"), tr("Tidemark session (*.%1)").arg(kSessionSuffix));
  if (!file.isEmpty()) save_to(window, file);
}

void SavedCases::save_to(CaseWindow& window, const QString& file, std::function<void()> done) {
  window.proxy().take_snapshot(window.view_state(), [this, about = about_writing(window, file), file, done,
                                                     saved = QPointer(&window)](const auto& snapshot) {
    run(
        about, file, [snapshot, path = path_of(file)] { return write_session(snapshot->contents, path); },
        [file, saved, snapshot, done] {
          if (!saved) return;
          saved->session_file = file;
          saved->proxy().mark_saved(*snapshot);
          if (done) done();
        });
  });
}

void SavedCases::ask_and_open() {
  const QString file = QFileDialog::getOpenFileName(&window_, tr("Open a session"),
                                                    QSettings().value("save/folder").toString(),
                                                    tr("Tidemark session (*.%1)").arg(kSessionSuffix));
  if (!file.isEmpty()) open(file);
}

void SavedCases::open(const QString& file) {
  read(file, {});
}

void SavedCases::open_rescued(const Recoverable& copy) {
  read(QString::fromStdU16String(copy.file.u16string()), copy.case_id);
}

// Sessions that are opened together are opened one after the other.
void SavedCases::read(const QString& file, const std::string& rescued) {
  waiting_.push_back({nullptr, file, rescued});
  if (waiting_.size() == 1) read_next();
}

void SavedCases::read_next() {
  const auto path = path_of(waiting_.front().file);
  const bool is_copy = !waiting_.front().rescued.empty();
  jobs_.push_back(BackgroundJob::start(this, [this, path, is_copy](BackgroundJob& job) {
    auto contents = without_exceptions([&] { return load_session(path); });
    if (!contents) {
      auto copies = is_copy ? std::vector<Recoverable>() : find_copies();
      job.deliver([this, message = QString::fromStdString(contents.error().message),
                   copies = std::move(copies)] { refuse(message, copies); });
      return;
    }
    job.deliver([this, contents = std::make_shared<const SessionContents>(std::move(*contents))] {
      find_volume(contents);
    });
  }));
}

// What else there is to go on with: another copy of the file, or one that was kept for a crash.
void SavedCases::refuse(const QString& problem, const std::vector<Recoverable>& copies) {
  const QString file = waiting_.front().file;
  const bool damaged = QFileInfo::exists(file);
  end_reading(damaged ? tr("%1. If you have another copy of this file, open that one.").arg(problem)
                      : problem);
  if (!damaged) return;
  offer(copies, tr("%1 cannot be read, but there are copies of work that was not saved, perhaps of the same "
                   "case:")
                    .arg(file));
}

void SavedCases::end_reading(const QString& problem) {
  if (!problem.isEmpty()) window_.tell(problem, kAboutOpening);
  waiting_.pop_front();
  if (!waiting_.empty()) read_next();
}

void SavedCases::find_volume(std::shared_ptr<const SessionContents> contents) {
  const StudyOrigin& origin = contents->origin;
  waiting_.front().contents = contents;
  if (!origin.phantom.empty()) return loader_.make_phantom(origin.phantom);
  loader_.load(origin.path, origin.series_uid, origin.policy);
}

// The volume is here: is it the one that the session is about? Comparing reads all of it.
void SavedCases::compare(const std::shared_ptr<const LoadedStudy>& study) {
  jobs_.push_back(
      BackgroundJob::start(this, [this, study, contents = waiting_.front().contents](BackgroundJob& job) {
        const auto found =
            without_exceptions([&]() -> Result<VolumeMatch> { return match(*contents, *study->volume); });
        job.deliver([this, study, found] {
          if (!found) return end_reading(QString::fromStdString(found.error().message));
          restore(study, *found);
        });
      }));
}

void SavedCases::restore(const std::shared_ptr<const LoadedStudy>& study, VolumeMatch found) {
  const Waiting waiting = waiting_.front();
  if (found == VolumeMatch::other_grid) {
    return end_reading(
        tr("The study of the session %1 is another one now: its size or place differ").arg(waiting.file));
  }
  if (found == VolumeMatch::other_voxels &&
      QMessageBox::question(
          &window_, tr("Open a session"),
          tr("The voxels of this study are not those that the session was saved with. Go on "
             "all the same? Nothing is overwritten.")) != QMessageBox::Yes) {
    return end_reading();
  }
  CaseWindow* window = window_.add_case(study, {waiting.contents, !waiting.rescued.empty()});
  if (waiting.rescued.empty()) {
    window->session_file = waiting.file;
  } else {
    keep_rescued(*window, waiting.rescued);
  }
  end_reading();
}

// The copy goes once the case has one of its own, or the user has closed it.
void SavedCases::keep_rescued(CaseWindow& window, const std::string& copy) {
  const auto remove = [copy] { discard(recovery_folder(), copy); };
  connect(&window.autosave(), &CaseAutosave::saved, this, remove, Qt::SingleShotConnection);
  connect(&window, &QObject::destroyed, this, remove);
  window.autosave().save_soon();
}

// To tell whether a copy is whole, all of it is read.
void SavedCases::offer_rescued() {
  jobs_.push_back(BackgroundJob::start(this, [this](BackgroundJob& job) {
    job.deliver([this, copies = find_copies()] {
      offer(copies,
            tr("Tidemark did not end as it should the last time, and kept copies of what was not saved:"));
    });
  }));
}

void SavedCases::offer(const std::vector<Recoverable>& copies, const QString& why) {
  if (copies.empty()) return;
  const RescueAnswer answer = ask_about_copies(&window_, why, copies);
  for (const Recoverable& copy : copies) {
    if (answer == RescueAnswer::open) open_rescued(copy);
    if (answer == RescueAnswer::discard) discard(recovery_folder(), copy.case_id);
  }
}

void SavedCases::close(CaseWindow& window, QCloseEvent* event) {
  if (!window.proxy().state().modified) return event->accept();
  const auto answer = QMessageBox::question(
      &window_, tr("Close"), tr("%1 has changes that are not in a session file.").arg(window.proxy().name()),
      QMessageBox::Save | QMessageBox::Discard | QMessageBox::Cancel, QMessageBox::Save);
  event->setAccepted(answer == QMessageBox::Discard);
  if (answer != QMessageBox::Save) return;
  // It closes itself once the file is written.
  QString file = window.session_file;
  if (file.isEmpty()) {
    file = ask_for_file(window, tr("Save the session"), tr("Tidemark session (*.%1)").arg(kSessionSuffix));
  }
  if (file.isEmpty()) return;
  ++closing_;
  save_to(window, file, [this, closing = QPointer(&window)] {
    --closing_;
    if (closing) closing->close_saved();
  });
}

}  // namespace tidemark
