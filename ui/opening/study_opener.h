// From a path to a study: looks what is there, asks which series where there are several, and loads it.
#pragma once

#include <QObject>
#include <QPointer>
#include <QWidget>
#include <filesystem>

#include "session/study_loader.h"

namespace tidemark {

class SeriesBrowser;

// One study at a time; opening another gives up the one that is being opened.
class StudyOpener : public QObject {
  Q_OBJECT
 public:
  explicit StudyOpener(QWidget* window);  // the parent of dialogs

  enum class Ask {
    if_several,  // the only loadable series is loaded at once
    always,
  };
  void open(const QString& path, Ask ask = Ask::if_several);
  void open_series(const QString& path, const QString& uid);  // without asking
  void open_phantom(const QString& kind);
  void cancel();

  // Null while there is nothing to choose from.
  [[nodiscard]] SeriesBrowser* browser() const { return browser_; }

 signals:
  void began(const QString& what);                        // for LoadingView::begin()
  void progressed(double fraction, const QString& step);  // for LoadingView::set_progress()
  void opened(std::shared_ptr<const tidemark::LoadedStudy> study);
  void failed(const QString& message);  // for LoadingView::fail()
  void ended();  // nothing is being looked for or loaded (opened, given up, or to be chosen by the user)

 private:
  void look_at(const std::shared_ptr<const Catalogue>& catalogue);
  void load(const Series& series);
  void close_browser();

  QWidget* window_;
  StudyLoader loader_;
  QPointer<SeriesBrowser> browser_;
  QString path_;
  Ask ask_ = Ask::if_several;
};

}  // namespace tidemark
