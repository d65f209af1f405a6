// The page while no case is open: ways to open one.
#pragma once

#include <QStringList>
#include <QWidget>

#include "ui/opening/recent_studies.h"

class QBoxLayout;
class QGridLayout;
class QVBoxLayout;

namespace tidemark::ui {

class CardButton;

class StartPage : public QWidget {
  Q_OBJECT
 public:
  explicit StartPage(RecentStudies& recent, QWidget* parent = nullptr);

 signals:
  void open_folder();  // asks which
  void open_file();
  void dropped(const QStringList& paths);
  void recent_chosen(const tidemark::ui::RecentStudy& study);
  void phantom_chosen(const QString& kind);
  void lessons_wanted(QPoint at);  // their list, on the screen

 protected:
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dragLeaveEvent(QDragLeaveEvent* event) override;
  void dropEvent(QDropEvent* event) override;
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void showEvent(QShowEvent* event) override;
  void changeEvent(QEvent* event) override;

 private:
  void build();
  QWidget* build_opening();
  QWidget* build_lessons();
  QWidget* build_phantoms();
  void fill_recent();
  void arrange();  // the columns that have room beside each other
  void place_phantoms(bool in_pairs);

  RecentStudies& recent_;
  QBoxLayout* columns_ = nullptr;
  QWidget* opening_ = nullptr;
  QVBoxLayout* recent_list_ = nullptr;
  QGridLayout* phantom_grid_ = nullptr;
  QList<CardButton*> phantoms_;  // the one to try first at the front
  QWidget* content_ = nullptr;
  bool is_dragged_over_ = false;
};

}  // namespace tidemark::ui
