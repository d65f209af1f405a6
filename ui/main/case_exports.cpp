#include "ui/main/case_exports.h"

#include <QMessageBox>
#include <QPushButton>
#include <algorithm>

#include "core/atomic_file.h"
#include "document/segment_meshes.h"
#include "engine/engine.h"
#include "engine/message_text.h"
#include "imaging/files/png_file.h"
#include "imaging/files/volume_file.h"
#include "imaging/surface/surface.h"
#include "solver/speed/speed_registry.h"
#include "ui/main/case_files.h"
#include "ui/main/main_window.h"
#include "ui/panels/region_table.h"
#include "ui/panels/value_unit.h"
#include "ui/results/case_report.h"
#include "ui/views/picture_view.h"
#include "ui/widgets/number_text.h"
#include "ui/widgets/path_text.h"

namespace tidemark::ui {
namespace {

Status write_label_file(const document::SessionContents& contents, const std::filesystem::path& file) {
  Volume volume;
  volume.geometry = contents.geometry;
  std::vector<std::uint16_t> voxels(static_cast<std::size_t>(contents.geometry.voxel_count()));
  if (contents.label_voxels) {
    const std::vector<std::uint8_t> labels = contents.label_voxels->voxels();
    std::copy(labels.begin(), labels.end(), voxels.begin());
  }
  volume.voxels = std::move(voxels);
  return imaging::write_volume_file(volume, file);
}

// A picture of a view as it is, with nothing that tells who the patient is.
QImage picture_of(CaseWindow& window, PictureView& view) {
  engine::Display& display = window.proxy().display();
  const bool text = display.settings().patient_text;
  display.change([](engine::DisplaySettings& settings) { settings.patient_text = false; });
  const QImage image = view.grab_picture();
  display.change([text](engine::DisplaySettings& settings) { settings.patient_text = text; });
  return image;
}

// The functions by the names that the panel has for them.
QString driven_by(const document::Drive& drive) {
  QStringList parts;
  for (const solver::SpeedTerm& term : drive.setting.terms) {
    const solver::SpeedKind* kind = solver::speed_kind(term.function);
    parts << engine::message_text(std::string(kind ? kind->title : term.function));
  }
  if (drive.constraints && drive.constraints->count(solver::Constraint::wall) +
                                   drive.constraints->count(solver::Constraint::anchor) >
                               0)
    parts << CaseExports::tr("walls and anchors");
  return parts.join(QStringLiteral(", "));
}

std::vector<std::pair<QString, QString>> parameters_of(const engine::CaseProxy& proxy) {
  const engine::CaseState& state = proxy.state();
  if (!state.begun) return {};
  std::vector<std::pair<QString, QString>> parameters{
      {CaseExports::tr("Start"), state.start_text}, {CaseExports::tr("Driven by"), driven_by(proxy.drive())}};
  if (document::uses_tent(proxy.drive())) {
    const int decimals = value_decimals(proxy.summary().high - proxy.summary().low);
    const QString unit = value_unit(proxy.volume());
    parameters.emplace_back(CaseExports::tr("Target T"),
                            number_text(state.parameters.target, decimals, unit));
    parameters.emplace_back(CaseExports::tr("Range ε"), number_text(state.parameters.range, decimals, unit));
  }
  parameters.emplace_back(CaseExports::tr("Data weight α"), number_text(state.parameters.alpha, 3));
  if (state.smoothed_mm > 0.0)
    parameters.emplace_back(CaseExports::tr("Smoothed by"),
                            number_text(state.smoothed_mm, 1, CaseExports::tr("mm")));
  parameters.emplace_back(CaseExports::tr("Steps"), count_text(state.step));
  return parameters;
}

// The patient is named while the views do so, too.
ReportSource report_source(CaseWindow& window) {
  engine::CaseProxy& proxy = window.proxy();
  const engine::LoadedStudy& study = proxy.study();
  ReportSource source;
  source.study = study.name;
  source.date = QString::fromStdString(study.date);
  if (proxy.display().settings().patient_text && study.patient != imaging::Patient{})
    source.patient = study.patient;
  source.volume = study.volume;
  for (const engine::Measurement& one : proxy.display().settings().measurements) {
    if (one.complete()) source.measurements.push_back(one);
  }
  source.parameters = parameters_of(proxy);
  for (PictureView* view : window.views()) {
    if (view->isVisible()) source.pictures.emplace_back(view->title(), picture_of(window, *view));
  }
  return source;
}

}  // namespace

CaseExports::CaseExports(MainWindow& window, CaseFiles& files)
    : QObject(&window), window_(window), files_(files), receiver_(engine::WeakReceiver::of(this)) {}

CaseExports::~CaseExports() {
  receiver_->close();
}

CaseExports::Voxels CaseExports::ask_for_voxels(const CaseWindow& window) {
  QMessageBox box(QMessageBox::Question, tr("Export"), tr("What is to be written?"), QMessageBox::Cancel,
                  &window_);
  QAbstractButton* surface = box.addButton(tr("Inside of the surface"), QMessageBox::AcceptRole);
  QAbstractButton* labels = box.addButton(tr("All labels"), QMessageBox::AcceptRole);
  const QPointer alive(&window);
  box.exec();
  if (alive && box.clickedButton() == surface) return Voxels::surface;
  return alive && box.clickedButton() == labels ? Voxels::labels : Voxels::nothing;
}

void CaseExports::export_mask(CaseWindow& window) {
  const bool has_labels = !window.proxy().state().labels.empty();
  const Voxels voxels = has_labels ? ask_for_voxels(window) : Voxels::surface;
  if (voxels == Voxels::nothing) return;
  const QString file =
      files_.ask_for_file(window, voxels == Voxels::labels ? tr("Export labels") : tr("Export mask"),
                          tr("NIfTI (*.nii.gz *.nii);;NRRD (*.nrrd);;MetaImage (*.mha)"));
  if (file.isEmpty()) return;
  voxels == Voxels::labels ? write_labels(window, file) : write_mask(window, file);
}

void CaseExports::write_mask(CaseWindow& window, const QString& file) {
  files_.write_contents(window, file, [path = path_of(file)](const document::SessionContents& contents) {
    return imaging::write_mask_file(contents.phi->mask(), path);
  });
}

void CaseExports::write_labels(CaseWindow& window, const QString& file) {
  files_.write_contents(window, file, [path = path_of(file)](const document::SessionContents& contents) {
    return write_label_file(contents, path);
  });
}

void CaseExports::export_mesh(CaseWindow& window) {
  const QString file = files_.ask_for_file(window, tr("Export the surface"),
                                           tr("STL (*.stl);;PLY (*.ply);;Wavefront OBJ (*.obj)"));
  if (!file.isEmpty()) write_surface(window, file);
}

void CaseExports::write_surface(CaseWindow& window, const QString& file) {
  files_.write_contents(window, file,
                        [path = path_of(file)](const document::SessionContents& contents) -> Status {
                          const auto mesh = document::mesh_of(*contents.phi);
                          if (!mesh) return pass_on(mesh);
                          return imaging::write_mesh(*mesh, path);
                        });
}

void CaseExports::export_picture(CaseWindow& window) {
  const QString file = files_.ask_for_file(window, tr("Export the picture"), tr("PNG (*.png)"));
  if (!file.isEmpty()) write_picture(window, file);
}

void CaseExports::write_picture(CaseWindow& window, const QString& file) {
  PictureView* view = window.active_view();
  if (!view) return;
  const QImage image = picture_of(window, *view).convertToFormat(QImage::Format_RGBA8888);
  files_.write(window, file, [image, path = path_of(file)] {
    return imaging::write_png_file(
        image.width(), image.height(),
        std::span(image.constBits(), static_cast<std::size_t>(image.sizeInBytes())), path);
  });
}

void CaseExports::export_statistics(CaseWindow& window) {
  const QString file = files_.ask_for_file(window, tr("Export statistics"), tr("Table (*.csv)"));
  if (!file.isEmpty()) write_statistics(window, file);
}

void CaseExports::write_statistics(CaseWindow& window, const QString& file) {
  files_.write(window, file,
               [csv = to_csv(window.proxy()), path = path_of(file)] { return write_file(path, csv); });
}

void CaseExports::export_comparison(CaseWindow& window, const std::string& csv) {
  const QString file = files_.ask_for_file(window, tr("Export the comparison"), tr("Table (*.csv)"));
  if (file.isEmpty()) return;
  files_.write(window, file, [csv, path = path_of(file)] { return write_file(path, csv); });
}

void CaseExports::export_report(CaseWindow& window) {
  const QString file =
      files_.ask_for_file(window, tr("Write a report"), tr("PDF (*.pdf);;Web page (*.html)"));
  if (!file.isEmpty()) write_report(window, file);
}

void CaseExports::write_report(CaseWindow& window, const QString& file) {
  const auto write = [this, file, alive = QPointer(&window)] {
    if (!alive) return;
    files_.write_contents(
        *alive, file,
        [source = report_source(*alive), path = path_of(file)](const document::SessionContents& contents) {
          return ui::write_report(source, contents, path);
        });
  };
  window.proxy().pause();
  window.proxy().measure([write, alive = QPointer(&window), receiver = receiver_] {
    if (!alive) return;
    // Pictures of the surface at which it paused come before.
    alive->proxy().engine().post(engine::Priority::step, nullptr,
                                 [write, receiver](const std::stop_token&) { receiver->send(write); });
  });
}

void CaseExports::export_recipe(CaseWindow& window) {
  const QString file = files_.ask_for_file(window, tr("Export the recipe"), tr("Recipe (*.json)"));
  if (file.isEmpty()) return;
  files_.write_contents(window, file,
                        [path = path_of(file)](const document::SessionContents& contents) -> Status {
                          const auto text = contents.recipe.to_text();
                          if (!text) return pass_on(text);
                          return write_file(path, *text);
                        });
}

}  // namespace tidemark::ui
