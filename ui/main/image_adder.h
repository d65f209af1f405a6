// Further images of an open case: another series of its study, or any file.
#pragma once

#include <QObject>
#include <QPointer>
#include <memory>

#include "ui/main/case_window.h"

namespace tidemark::engine {
struct LoadedStudy;
}

namespace tidemark::ui {

class LoadingView;
class MainWindow;
class StudyOpener;

class ImageAdder : public QObject {
  Q_OBJECT
 public:
  explicit ImageAdder(MainWindow& window);

  void ask_for_file(CaseWindow& into);
  // Chosen from the folder or archive that the case came from.
  void ask_for_series(CaseWindow& into);
  void add_file(CaseWindow& into, const QString& path);

 private:
  void connect_opener();
  void add(const engine::LoadedStudy& loaded);

  MainWindow& window_;
  StudyOpener* opener_;
  LoadingView* progress_;
  QPointer<CaseWindow> into_;
};

}  // namespace tidemark::ui
