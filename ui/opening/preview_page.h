// A first look at the study that is being loaded: its middle slice.
#pragma once

#include <QImage>
#include <QStackedWidget>
#include <QWidget>

namespace tidemark::ui {

class StudyOpener;

// A page of `pages` with a picture of the study that is being loaded. It replaces the first page until the
// study is there or given up; any other page stays, so that work on a case is not disturbed.
class PreviewPage : public QWidget {
  Q_OBJECT
 public:
  PreviewPage(QStackedWidget& pages, const StudyOpener& opener);

 signals:
  void painted();

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  void show_picture(const QImage& middle_slice);
  void forget();

  QStackedWidget& pages_;
  QImage picture_;
};

}  // namespace tidemark::ui
