// Further images of an open case: another series of its study, or any file.
#pragma once

#include <QObject>
#include <QPointer>
#include <memory>

#include "ui/main/case_window.h"

namespace tidemark::engine {
class BackgroundJob;
struct LoadedStudy;
struct ShownImage;
}  // namespace tidemark::engine

namespace tidemark::ui {

class LoadingView;
class MainWindow;
class StudyOpener;

class ImageAdder : public QObject {
  Q_OBJECT
 public:
  explicit ImageAdder(MainWindow& window);
  ~ImageAdder() override;

  void ask_for_file(CaseWindow& into);
  // Chosen from the folder or archive that the case came from.
  void ask_for_series(CaseWindow& into);
  void add_file(CaseWindow& into, const QString& path);

 private:
  void connect_opener();
  // Beside the user interface: the checksum, and whether it meets the study.
  void look_at(const std::shared_ptr<const engine::LoadedStudy>& loaded);
  void refuse(const engine::LoadedStudy& loaded);
  void add(const engine::LoadedStudy& loaded, const engine::ShownImage& shown);

  MainWindow& window_;
  StudyOpener* opener_;
  LoadingView* progress_;
  QPointer<CaseWindow> into_;
  std::shared_ptr<engine::BackgroundJob> job_;  // that looks at an image
};

}  // namespace tidemark::ui
