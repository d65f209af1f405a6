// Files of cases: where to, and writing them.
#pragma once

#include <QHash>
#include <QObject>
#include <filesystem>
#include <functional>
#include <list>
#include <memory>
#include <vector>

#include "core/result.h"
#include "ui/main/case_window.h"

namespace tidemark::engine {
class BackgroundJob;
}

namespace tidemark::ui {

class MainWindow;

// Files are written on threads of their own; how it went is said in the window. What goes to one file is
// written in the order of the calls.
class CaseFiles : public QObject {
  Q_OBJECT
 public:
  explicit CaseFiles(MainWindow& window);
  ~CaseFiles() override;

  // Empty when none is wanted, or the case was closed meanwhile. The suffixes are those of a file dialog; a
  // name without any of them gets the first.
  [[nodiscard]] QString ask_for_file(CaseWindow& window, const QString& title, const QString& suffixes);

  using Work = std::function<Status()>;
  using Ended = std::function<void(bool written)>;
  void write(CaseWindow& window, const QString& file, Work work, Ended ended = {});
  // From what the case is like now.
  void write_contents(CaseWindow& window, const QString& file,
                      std::function<Status(const document::SessionContents&)> work);
  [[nodiscard]] bool writing() const { return !writes_.empty(); }
  // Whether write_contents() still waits for what the case is like.
  [[nodiscard]] bool waits_for(const CaseWindow& window) const { return awaited_.contains(&window); }

 signals:
  void waits_no_more(const tidemark::ui::CaseWindow* window);
  void written(const QString& file);
  void ended();  // well or not

 private:
  struct Write {
    QString about;
    QString file;
    Work work;
    Ended ended;
    Write* next = nullptr;  // to the same file; it waits for this one
  };

  void run(Write write);
  void start(Write& write);
  void end(const Write& write, const Status& status);
  void await(const CaseWindow& window);
  void no_longer_await(const CaseWindow* window);

  MainWindow& window_;
  std::list<Write> writes_;                // that have not ended
  QHash<const CaseWindow*, int> awaited_;  // how often
  std::vector<std::shared_ptr<engine::BackgroundJob>> jobs_;
};

}  // namespace tidemark::ui
