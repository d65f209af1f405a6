#include "ui/main/session_reader.h"

#include <QFileDialog>
#include <QFileInfo>
#include <QStatusBar>
#include <algorithm>
#include <utility>

#include "core/without_exceptions.h"
#include "document/session_file.h"
#include "document/session_images.h"
#include "engine/background_job.h"
#include "engine/case_autosave.h"
#include "engine/message_text.h"
#include "ui/main/case_files.h"
#include "ui/main/main_window.h"
#include "ui/main/message_bar.h"
#include "ui/main/session_writer.h"
#include "ui/main/teaching.h"
#include "ui/settings.h"
#include "ui/widgets/path_text.h"
#include "ui/widgets/question.h"
#include "ui/widgets/status_progress.h"

namespace tidemark::ui {
namespace {

// What programs left behind that died; nothing where there is no memory even for that.
std::vector<document::Recoverable> find_copies() {
  auto found = without_exceptions([]() -> Result<std::vector<document::Recoverable>> {
    document::sweep_unfinished(engine::recovery_folder());
    return document::find_recoverable(engine::recovery_folder());
  });
  return found ? std::move(*found) : std::vector<document::Recoverable>();
}

// The newest; older ones are offered after it.
std::optional<document::RescuedLesson> find_lesson() {
  const auto age = [](const document::RescuedLesson& one) {
    std::error_code ignored;
    return std::filesystem::last_write_time(one.copy, ignored);
  };
  auto found = without_exceptions([]() -> Result<std::vector<document::RescuedLesson>> {
    return document::find_rescued_lessons(engine::recovery_folder());
  });
  if (!found || found->empty()) return std::nullopt;
  return *std::max_element(found->begin(), found->end(),
                           [&](const auto& one, const auto& other) { return age(one) < age(other); });
}

}  // namespace

SessionReader::SessionReader(MainWindow& window)
    : QObject(&window), window_(window), progress_(new StatusProgress(*window.statusBar())) {
  connect(progress_, &StatusProgress::cancelled, this, &SessionReader::cancel);
  connect(&loader_, &engine::StudyLoader::progressed, progress_, &StatusProgress::set_progress);
  connect(&loader_, &engine::StudyLoader::loaded, this, &SessionReader::compare);
  connect(&loader_, &engine::StudyLoader::failed, this, [this](const QString& message) {
    end_reading(tr("The study of the session %1 was not found: %2").arg(waiting_.front().file, message));
  });
}

SessionReader::~SessionReader() {
  for (const auto& job : {reading_, finding_}) {
    if (job) job->abandon();
  }
}

void SessionReader::ask_and_open() {
  const QString file = QFileDialog::getOpenFileName(&window_, tr("Open a session"),
                                                    settings::save_folder().get(), session_filter());
  if (!file.isEmpty()) open(file);
}

// A file is open once: two cases would write over each other's work.
void SessionReader::open(const QString& file) {
  if (CaseWindow* window = window_.case_of_session(file)) return window_.bring_to_front(*window);
  if (!reads(file)) read(file, {});
}

bool SessionReader::reads(const QString& file) const {
  return std::any_of(waiting_.begin(), waiting_.end(),
                     [&](const Waiting& waiting) { return is_same_place(waiting.file, file); });
}

void SessionReader::read(const QString& file, const std::string& rescued) {
  waiting_.push_back({nullptr, file, rescued});
  if (waiting_.size() == 1) read_next();
}

void SessionReader::read_next() {
  const auto path = path_of(waiting_.front().file);
  const bool is_copy = !waiting_.front().rescued.empty();
  progress_->begin(tr("Opening %1").arg(QFileInfo(waiting_.front().file).fileName()));
  carry_out([this, path, is_copy](engine::BackgroundJob& job) {
    auto contents = without_exceptions([&] { return document::load_session(path); });
    if (!contents) {
      auto copies = is_copy ? std::vector<document::Recoverable>() : find_copies();
      job.deliver([this, message = engine::message_text(contents.error()), copies = std::move(copies)] {
        refuse(message, copies);
      });
      return;
    }
    job.deliver([this, contents = std::make_shared<const document::SessionContents>(std::move(*contents))] {
      find_volume(contents);
    });
  });
}

// The reading that is cut off ends: others wait for it.
void SessionReader::carry_out(std::function<void(engine::BackgroundJob&)> work) {
  reading_ = engine::BackgroundJob::start(
      this, std::move(work), [this](const Error& error) { end_reading(engine::message_text(error)); });
}

// What hangs may do so until the end of the program: nobody waits for it any more.
void SessionReader::cancel() {
  if (waiting_.empty()) return;
  reading_->abandon();
  loader_.cancel();
  end_reading();
}

// What else there is to go on with: another copy of the file, or one that was kept for a crash.
void SessionReader::refuse(const QString& problem, const std::vector<document::Recoverable>& copies) {
  const QString file = waiting_.front().file;
  const bool damaged = QFileInfo::exists(file);
  end_reading(damaged ? tr("%1. If you have another copy of this file, open that one.").arg(problem)
                      : problem);
  if (!damaged) return;
  offer({copies, {}},
        tr("%1 cannot be read, but there are copies of work that was not saved, perhaps of the same "
           "case:")
            .arg(file));
}

void SessionReader::end_reading(const QString& problem) {
  if (!problem.isEmpty()) window_.tell(problem, kAboutOpening);
  progress_->hide();
  waiting_.pop_front();
  if (!waiting_.empty()) read_next();
}

void SessionReader::find_volume(std::shared_ptr<const document::SessionContents> contents) {
  const document::StudyOrigin& origin = contents->origin;
  waiting_.front().contents = contents;
  if (!origin.phantom.empty()) return loader_.make_phantom(origin.phantom);
  loader_.load(origin.path, origin.series_uid, origin.policy);
}

// The volume is here: is it the one that the session is about? Comparing reads all of it.
void SessionReader::compare(const std::shared_ptr<const engine::LoadedStudy>& study) {
  carry_out([this, study, contents = waiting_.front().contents](engine::BackgroundJob& job) {
    const auto found = document::match(*contents, *study->volume);
    job.deliver([this, study, found] { judge(study, found); });
  });
}

void SessionReader::judge(const std::shared_ptr<const engine::LoadedStudy>& study,
                          document::VolumeMatch found) {
  const Waiting waiting = waiting_.front();
  if (found == document::VolumeMatch::other_grid) {
    return end_reading(
        tr("The study of the session %1 is another one now: its size or place differ").arg(waiting.file));
  }
  if (found == document::VolumeMatch::other_voxels &&
      ask(&window_, tr("Open a session"),
          tr("The voxels of this study are not those that the session was saved with. Go on "
             "all the same? Nothing is overwritten."),
          QMessageBox::Yes | QMessageBox::No, QMessageBox::Yes) != QMessageBox::Yes) {
    return end_reading();
  }
  waiting_.front().other_voxels = found == document::VolumeMatch::other_voxels;
  find_images(study);
}

// They are read once the study is known to be the right one.
void SessionReader::find_images(const std::shared_ptr<const engine::LoadedStudy>& study) {
  const auto contents = waiting_.front().contents;
  carry_out([this, study, contents](engine::BackgroundJob& job) {
    auto with_images = std::make_shared<document::SessionContents>(*contents);
    QStringList problems;
    for (const std::string& problem : document::find_images(*with_images, {nullptr, job.stop()}))
      problems << engine::message_text(problem);
    job.deliver([this, study, with_images, problems] { restore(study, with_images, problems); });
  });
}

void SessionReader::restore(const std::shared_ptr<const engine::LoadedStudy>& study,
                            std::shared_ptr<const document::SessionContents> contents,
                            const QStringList& problems) {
  const Waiting waiting = waiting_.front();
  // A file about other voxels is never written over with these.
  const bool in_file = waiting.rescued.empty() && !waiting.other_voxels;
  CaseWindow* window = window_.add_case(study, {std::move(contents), !in_file});
  if (in_file) {
    window->session_file = waiting.file;
    emit opened(*window);
  }
  if (!waiting.rescued.empty()) keep_rescued(*window, waiting.rescued);
  end_reading(problems.join(QLatin1Char('\n')));
}

// The copy goes once the case has one of its own, or the user has closed it.
void SessionReader::keep_rescued(CaseWindow& window, const std::string& copy) {
  const auto remove = [copy] { document::discard(engine::recovery_folder(), copy); };
  connect(&window.autosave(), &engine::CaseAutosave::saved, this, remove, Qt::SingleShotConnection);
  const auto closed = connect(&window, &QObject::destroyed, this, remove);
  connect(&window.proxy(), &engine::CaseProxy::given_up, this, [closed] { disconnect(closed); });
  // Behind what shows the case as it was, which is queued, too: the new copy has its images and measurements.
  QMetaObject::invokeMethod(&window.autosave(), &engine::CaseAutosave::save_soon, Qt::QueuedConnection);
}

// To tell whether a copy is whole, all of it is read.
void SessionReader::offer_rescued() {
  if (finding_) finding_->abandon();
  finding_ = engine::BackgroundJob::start(this, [this](engine::BackgroundJob& job) {
    const auto work = std::make_shared<const RescuedWork>(RescuedWork{find_copies(), find_lesson()});
    job.deliver([this, work] {
      offer(*work,
            tr("Tidemark did not end as it should the last time, and kept copies of what was not saved:"));
    });
  });
}

void SessionReader::offer(const RescuedWork& work, const QString& why) {
  if (work.empty()) return;
  const RescueAnswer answer = ask_about_copies(&window_, why, work);
  if (answer == RescueAnswer::later) return;
  const bool open = answer == RescueAnswer::open;
  for (const document::Recoverable& copy : work.cases) {
    if (open) {
      read(text_of(copy.file), copy.case_id);
    } else {
      document::discard(engine::recovery_folder(), copy.case_id);
    }
  }
  if (!work.lesson) return;
  if (open) {
    window_.teaching().go_on(*work.lesson);
  } else {
    document::discard_lesson(engine::recovery_folder(), work.lesson->id);
  }
}

}  // namespace tidemark::ui
