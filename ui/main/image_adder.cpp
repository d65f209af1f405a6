#include "ui/main/image_adder.h"

#include <QFileDialog>
#include <QPointer>
#include <QStatusBar>
#include <memory>
#include <vector>

#include "engine/background_job.h"
#include "engine/message_text.h"
#include "imaging/onto_grid.h"
#include "imaging/share_space.h"
#include "ui/main/main_window.h"
#include "ui/main/panel_docks.h"
#include "ui/opening/study_opener.h"
#include "ui/settings.h"
#include "ui/widgets/file_patterns.h"
#include "ui/widgets/status_progress.h"

namespace tidemark::ui {
namespace {

constexpr const char* kAboutImages = "adding an image";

}  // namespace

// The images of one case: it need not be the active one any more when they have been read.
class ImageAdder::OfCase : public QObject {
 public:
  OfCase(MainWindow& window, CaseWindow& into);
  ~OfCase() override;

  [[nodiscard]] StudyOpener& opener() { return *opener_; }

 private:
  // Beside the user interface: the checksum, and whether it meets the study.
  void look_at(const std::shared_ptr<const engine::LoadedStudy>& loaded);
  void refuse(const engine::LoadedStudy& loaded);
  void add(const engine::LoadedStudy& loaded, const engine::ShownImage& shown);

  MainWindow& window_;
  CaseWindow& into_;
  StudyOpener* opener_;
  QPointer<StatusProgress> progress_;                         // the status bar's
  std::vector<std::shared_ptr<engine::BackgroundJob>> jobs_;  // that look at images
};

ImageAdder::OfCase::OfCase(MainWindow& window, CaseWindow& into)
    : QObject(&into),
      window_(window),
      into_(into),
      opener_(new StudyOpener(&into)),
      progress_(new StatusProgress(*window.statusBar())) {
  opener_->set_previews_wanted(false);
  opener_->show_in(*progress_);
  connect(opener_, &StudyOpener::opened, this, &OfCase::look_at);
  connect(opener_, &StudyOpener::failed, this,
          [this](const QString& message) { window_.tell(into_, message, kAboutImages); });
}

ImageAdder::OfCase::~OfCase() {
  for (const auto& job : jobs_) job->abandon();
  delete progress_;
}

void ImageAdder::OfCase::look_at(const std::shared_ptr<const engine::LoadedStudy>& loaded) {
  const auto failed = [this](const Error& error) {
    window_.tell(into_, engine::message_text(error), kAboutImages);
  };
  jobs_.push_back(engine::BackgroundJob::start(
      this,
      [this, loaded, grid = into_.proxy().volume().geometry](engine::BackgroundJob& job) {
        const engine::ShownImage shown = engine::shown_image(*loaded, job.stop());
        const bool meets = imaging::share_space(shown.image->volume->geometry, shown.image->to_case, grid);
        job.deliver([this, loaded, shown, meets] { meets ? add(*loaded, shown) : refuse(*loaded); });
      },
      failed));
}

void ImageAdder::OfCase::refuse(const engine::LoadedStudy& loaded) {
  window_.tell(
      into_,
      ImageAdder::tr("%1 lies elsewhere in the patient than the study: its %2 share no place with the "
                     "study's %3.")
          .arg(loaded.name, engine::message_text(imaging::describe(loaded.volume->geometry)),
               engine::message_text(imaging::describe(into_.proxy().volume().geometry))),
      kAboutImages);
}

void ImageAdder::OfCase::add(const engine::LoadedStudy& loaded, const engine::ShownImage& shown) {
  engine::CaseProxy& proxy = into_.proxy();
  Status added;
  proxy.display().change(
      [&](engine::DisplaySettings& settings) { added = engine::add_image(settings.images, shown); });
  if (!added) return window_.tell(into_, engine::message_text(added.error()), kAboutImages);
  if (&into_ == window_.active_case()) window_.panels().show("display");
  if (engine::is_placed(*shown.image, proxy.study())) return window_.dismiss_about(kAboutImages);
  const bool differs =
      !loaded.frame_of_reference_uid.empty() && !proxy.study().frame_of_reference_uid.empty();
  window_.tell(
      into_,
      differs ? ImageAdder::tr("%1 has another frame of reference than the study: the patient may have moved "
                               "between them. Compare them before you rely on their places.")
                    .arg(loaded.name)
              : ImageAdder::tr(
                    "It is not known whether %1 has the study's frame of reference. Compare them before "
                    "you rely on their places.")
                    .arg(loaded.name),
      kAboutImages);
}

ImageAdder::ImageAdder(MainWindow& window) : QObject(&window), window_(window) {
  const auto with_case = [this](QAction* action, auto act) {
    connect(action, &QAction::triggered, this, [this, act] {
      if (CaseWindow* active = window_.active_case()) (this->*act)(*active);
    });
  };
  with_case(window.actions().add_image, &ImageAdder::ask_for_file);
  with_case(window.actions().add_series, &ImageAdder::ask_for_series);
}

ImageAdder::OfCase& ImageAdder::of(CaseWindow& into) {
  OfCase*& known = of_cases_[into];
  if (known == nullptr) known = new OfCase(window_, into);
  return *known;
}

void ImageAdder::ask_for_file(CaseWindow& into) {
  auto* dialog = new QFileDialog(&into, tr("Add an image"), settings::open_folder().get(),
                                 tr("Images (*.dcm %1);;All files (*)").arg(QLatin1String(kVolumePatterns)));
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setFileMode(QFileDialog::ExistingFile);
  const auto& origin = into.proxy().origin().path;
  if (!origin.empty()) dialog->setDirectory(QString::fromStdString(origin.parent_path().string()));
  connect(dialog, &QFileDialog::fileSelected, this, [this, to = QPointer(&into)](const QString& file) {
    if (to) add_file(*to, file);
  });
  dialog->open();
}

void ImageAdder::ask_for_series(CaseWindow& into) {
  const auto& origin = into.proxy().origin().path;
  if (origin.empty())
    return window_.tell(tr("This study was made here: it has no other series."), kAboutImages);
  of(into).opener().open(QString::fromStdString(origin.string()), StudyOpener::Ask::always);
}

void ImageAdder::add_file(CaseWindow& into, const QString& path) {
  of(into).opener().open(path);
}

}  // namespace tidemark::ui
