#include "ui/main/film_writer.h"

#include <QFileInfo>
#include <QStatusBar>
#include <algorithm>
#include <cmath>

#include "engine/film.h"
#include "imaging/audit/event.h"
#include "ui/main/case_files.h"
#include "ui/main/main_window.h"
#include "ui/views/picture_view.h"
#include "ui/widgets/path_text.h"
#include "ui/widgets/status_progress.h"

namespace tidemark::ui {
namespace {

constexpr double kLongestSide = 640.0;  // pixels
constexpr const char* kAboutFilms = "film";

renderer::PictureSize size_of_film(QSize view) {
  const double scale = std::min(1.0, kLongestSide / std::max(view.width(), view.height()));
  return {std::max<std::int64_t>(std::llround(scale * view.width()), 1),
          std::max<std::int64_t>(std::llround(scale * view.height()), 1)};
}

}  // namespace

FilmWriter::FilmWriter(MainWindow& window, CaseFiles& files)
    : QObject(&window), window_(window), files_(files), progress_(new StatusProgress(*window.statusBar())) {
  progress_->follow(jobs_);
  connect(&jobs_, &engine::ResultJobs::cancelled, this, [this] {
    progress_->hide();
    emit ended();
  });
  connect(&jobs_, &engine::ResultJobs::failed, this, [this](const QString& message) {
    progress_->hide();
    window_.tell(message, kAboutFilms);
    emit ended();
  });
  connect(&jobs_, &engine::ResultJobs::written, this, [this] {
    progress_->hide();
    window_.dismiss_about(kAboutFilms);
    window_.statusBar()->showMessage(tr("Wrote %1").arg(file_), 8000);
    emit files_.written(file_);
    emit ended();
  });
}

bool FilmWriter::may_begin() {
  if (jobs_.busy()) window_.tell(tr("A film is being written already."), kAboutFilms);
  return !jobs_.busy();
}

void FilmWriter::ask_and_write(CaseWindow& window) {
  if (!may_begin()) return;
  const QString file = files_.ask_for_file(window, tr("Export a film of the evolution"), tr("GIF (*.gif)"));
  if (!file.isEmpty()) write(window, file);
}

void FilmWriter::write(CaseWindow& window, const QString& file) {
  const PictureView* view = window.active_view();
  if (!view) return;
  const auto size = size_of_film(view->size());
  window.proxy().take_snapshot(
      window.view_state(), [this, file, size, wanted = view->wanted(),
                            study = window.proxy().shared_study()](const auto& snapshot) {
        if (!may_begin()) return;
        file_ = file;
        progress_->begin(tr("Writing %1").arg(QFileInfo(file).fileName()));
        jobs_.write([=, path = path_of(file)](const Progress& progress) {
          return imaging::exported(
              engine::write_film(snapshot->contents.recipe, study->volume, wanted, size, path, progress),
              study->audited, {path});
        });
      });
}

}  // namespace tidemark::ui
