// Session files, and copies that a program left behind that died, opened as cases.
#pragma once

#include <QObject>
#include <QStringList>
#include <deque>
#include <functional>
#include <memory>
#include <vector>

#include "document/autosave.h"
#include "document/session_contents.h"
#include "engine/study_loader.h"
#include "ui/main/case_window.h"
#include "ui/main/rescue_dialog.h"

namespace tidemark::engine {
class BackgroundJob;
}

namespace tidemark::ui {

class MainWindow;
class StatusProgress;

// Sessions that are opened together are opened one after the other. The status bar has the one that is being
// read, and a button that gives it up.
class SessionReader : public QObject {
  Q_OBJECT
 public:
  explicit SessionReader(MainWindow& window);
  ~SessionReader() override;

  void ask_and_open();
  void open(const QString& file);
  // Whether a case of that session is on its way.
  [[nodiscard]] bool reads(const QString& file) const;

  // Tells of copies of cases, and of a lesson's answers, that a program left behind that died, and opens them
  // if the user wants.
  void offer_rescued();

 signals:
  void opened(tidemark::ui::CaseWindow& window);  // from its session_file

 private:
  // A session that waits for its volume.
  struct Waiting {
    std::shared_ptr<const document::SessionContents> contents;
    QString file;
    std::string rescued;        // the copy's case; empty: a file of the user's
    bool other_voxels = false;  // than the study has now
  };

  void read(const QString& file, const std::string& rescued);
  void read_next();
  void carry_out(std::function<void(engine::BackgroundJob&)> work);
  void cancel();
  void refuse(const QString& problem, const std::vector<document::Recoverable>& copies);
  void end_reading(const QString& problem = {});
  void find_volume(std::shared_ptr<const document::SessionContents> contents);
  void compare(const std::shared_ptr<const engine::LoadedStudy>& study);
  void judge(const std::shared_ptr<const engine::LoadedStudy>& study, document::VolumeMatch found);
  void find_images(const std::shared_ptr<const engine::LoadedStudy>& study);
  void restore(const std::shared_ptr<const engine::LoadedStudy>& study,
               std::shared_ptr<const document::SessionContents> contents, const QStringList& problems);
  void offer(const RescuedWork& work, const QString& why);
  void keep_rescued(CaseWindow& window, const std::string& copy);

  MainWindow& window_;
  engine::StudyLoader loader_;
  StatusProgress* progress_;
  std::deque<Waiting> waiting_;                     // the first is being read
  std::shared_ptr<engine::BackgroundJob> reading_;  // its last piece of work
  std::shared_ptr<engine::BackgroundJob> finding_;  // what there is to rescue
};

}  // namespace tidemark::ui
