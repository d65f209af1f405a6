// Cases in files: sessions, and what is exported.
#pragma once

#include <QObject>
#include <deque>
#include <functional>
#include <memory>
#include <vector>

#include "core/result.h"
#include "document/autosave.h"
#include "engine/study_loader.h"
#include "ui/main/case_window.h"

class QCloseEvent;

namespace tidemark {

class BackgroundJob;
class MainWindow;

// Files are written on threads of their own, from what the case was like when it was asked for; how it went
// is said in the window.
class SavedCases : public QObject {
  Q_OBJECT
 public:
  explicit SavedCases(MainWindow& window);
  ~SavedCases() override;

  void save(CaseWindow& window);  // to its file; asks for one the first time
  void save_as(CaseWindow& window);
  void ask_and_open();
  void open(const QString& file);

  // Ask where to.
  void export_mask(CaseWindow& window);
  void export_mesh(CaseWindow& window);
  void export_picture(CaseWindow& window);
  void export_statistics(CaseWindow& window);
  void export_recipe(CaseWindow& window);

  // The same without asking. The suffix says which format.
  void write_mask(CaseWindow& window, const QString& file);
  void write_labels(CaseWindow& window, const QString& file);
  void write_surface(CaseWindow& window, const QString& file);
  void write_picture(CaseWindow& window, const QString& file);
  void write_statistics(CaseWindow& window, const QString& file);

  // Asks before something is lost.
  void close(CaseWindow& window, QCloseEvent* event);
  [[nodiscard]] bool closes_later() const { return closing_ > 0; }

  // Copies of cases that a program left behind that died: tells of them, and opens them if the user wants.
  void offer_rescued();
  void open_rescued(const Recoverable& copy);

 signals:
  void written(const QString& file);

 private:
  using Write = std::function<Status(const SessionContents&)>;
  // Empty when none is wanted, or the case was closed meanwhile.
  [[nodiscard]] QString ask_for_file(const CaseWindow& window, const QString& title, const QString& suffixes);
  void write(CaseWindow& window, const QString& file, Write work);
  void run(const QString& about, const QString& file, std::function<Status()> work,
           std::function<void()> done = {});
  void save_to(CaseWindow& window, const QString& file, std::function<void()> done = {});
  void read(const QString& file, const std::string& rescued);
  void read_next();
  void refuse(const QString& problem, const std::vector<Recoverable>& copies);
  void end_reading(const QString& problem = {});
  void find_volume(std::shared_ptr<const SessionContents> contents);
  void offer(const std::vector<Recoverable>& copies, const QString& why);
  void keep_rescued(CaseWindow& window, const std::string& copy);
  void compare(const std::shared_ptr<const LoadedStudy>& study);
  void restore(const std::shared_ptr<const LoadedStudy>& study, VolumeMatch found);

  // A session that waits for its volume.
  struct Waiting {
    std::shared_ptr<const SessionContents> contents;
    QString file;
    std::string rescued;  // the copy's case; empty: a file of the user's
  };

  MainWindow& window_;
  StudyLoader loader_;
  int closing_ = 0;              // cases that close once they are saved
  std::deque<Waiting> waiting_;  // the first is being read
  std::vector<std::shared_ptr<BackgroundJob>> jobs_;
};

}  // namespace tidemark
