// The panel History: the states of a case as a tree, the way to each of them, and the comparison of two.
#pragma once

#include "ui/panels/panel.h"

class QLabel;
class QListView;
class QPushButton;

namespace tidemark::ui {

class HistoryModel;

class HistoryPanel : public Panel {
  Q_OBJECT
 public:
  explicit HistoryPanel(QWidget* parent = nullptr);

 protected:
  void attach() override;
  void refresh() override;
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  QWidget* make_list();
  QWidget* make_comparison();
  void clicked(const QModelIndex& index);
  void go();
  void compare(bool on);
  void show_buttons();
  void show_comparison();

  HistoryModel* model_;
  QListView* list_;
  QPushButton* go_;
  QPushButton* compare_;
  QWidget* comparison_;
  QLabel* with_;
  QLabel* dice_;
  QLabel* mean_;
  QLabel* largest_;
  std::uint64_t followed_ = 0;  // the present state when the list was last scrolled to it
  QMetaObject::Connection compared_;
};

}  // namespace tidemark::ui
