// The way from a path to a study: search, choice among several series, loading.
#pragma once

#include <QMessageBox>
#include <QObject>
#include <QPointer>
#include <QStringList>
#include <QWidget>
#include <deque>
#include <filesystem>
#include <functional>
#include <optional>

#include "engine/result_finder.h"
#include "engine/series_preview.h"
#include "engine/study_loader.h"
#include "imaging/load_study.h"
#include "ui/opening/series_browser.h"

namespace tidemark::ui {

class StatusProgress;

// Opens one study after the other, in the order of the requests. While the user chooses a series, or how its
// slices become a regular grid, earlier requests wait. A new request during the choice gives the choice
// up.
class StudyOpener : public QObject {
  Q_OBJECT
 public:
  explicit StudyOpener(QWidget* window);  // the parent of dialogs

  enum class Ask {
    if_several,  // the only loadable series is loaded at once
    always,
  };
  void open(const QString& path, Ask ask = Ask::if_several);
  // Does not ask which series, and follows the policy for a tilt. Asks about gaps unless it fills them.
  void open_series(const QString& path, const QString& uid, const imaging::GridPolicy& policy = {});
  void open_phantom(const QString& kind);
  void cancel();  // the one that is being opened, and those that wait
  // Whether previewed() is needed; at first, yes. A preview of a volume file reads the whole file once
  // more.
  void set_previews_wanted(bool wanted) { previews_wanted_ = wanted; }
  // What is being opened, and how far it is. Its Cancel is cancel().
  void show_in(StatusProgress& progress);

  // Null while there is nothing to choose from, and nothing to ask.
  [[nodiscard]] SeriesBrowser* browser() const { return browser_; }
  [[nodiscard]] QMessageBox* question() const { return question_; }
  // What was found beside the study; none where it is not the one that was opened last.
  [[nodiscard]] std::vector<engine::FoundResult> results_beside(const engine::LoadedStudy& study) const;

 signals:
  void began(const QString& what);                        // "head_t1 (2 of 3)"
  void progressed(double fraction, const QString& step);  // as engine::JobRunner says it
  void previewed(const QImage& middle_slice);             // of what is being loaded; not of all series
  void opened(std::shared_ptr<const tidemark::engine::LoadedStudy> study);
  void failed(const QString& message);  // once for all that wait for each other
  void ended();  // nothing is being looked for or loaded (opened, given up, or to be chosen by the user)

 private:
  struct Request {
    QString what;
    std::function<void()> start;
  };
  void add(const QString& what, std::function<void()> start);
  void next();
  void begin(const QString& what);
  void look_at(const std::shared_ptr<const imaging::Catalogue>& catalogue);
  void load(const imaging::Series& series, const std::vector<std::string>& remarks = {});
  void load_by_uid(const imaging::Catalogue& catalogue);
  void load_as_wanted(const imaging::Series& series);  // asks first where there is something to ask
  void ask_for_policy(const imaging::Series& series);
  void close_questions();

  QWidget* window_;
  engine::StudyLoader loader_;
  engine::ResultFinder finder_;
  engine::SeriesPreviews previews_;
  bool previews_wanted_ = true;
  QPointer<SeriesBrowser> browser_;
  QPointer<QMessageBox> question_;
  std::deque<Request> waiting_;
  int number_ = 0;        // of the request that is worked on, from 1; 0: none is
  int asked_ = 0;         // requests since there was none
  QStringList problems_;  // of these
  QString path_;          // of the request
  std::shared_ptr<const imaging::Catalogue> catalogue_;  // found there
  imaging::ChosenSeries to_load_;                        // of these, when results were looked for
  std::vector<engine::FoundResult> results_;             // of the request
  std::weak_ptr<const engine::LoadedStudy> last_opened_;
  std::vector<engine::FoundResult> beside_last_opened_;
  std::optional<QString> uid_;
  Ask ask_ = Ask::if_several;
};

}  // namespace tidemark::ui
