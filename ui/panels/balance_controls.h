// The section "Why here?": the balance of the speed terms at a place, and what would have to change.
#pragma once

#include "ui/panels/case_widget.h"

class QCheckBox;
class QLabel;
class QPushButton;

namespace tidemark::ui {

class BalanceBars;

class BalanceControls : public CaseWidget {
  Q_OBJECT
 public:
  explicit BalanceControls(QWidget* parent = nullptr);

 protected:
  void attach() override;
  void refresh() override;

 private:
  void show_place();
  void resizeEvent(QResizeEvent* event) override;
  void scroll_here();

  QWidget* content_;  // seen once something is asked, or may be
  QLabel* why_;
  QWidget* found_;  // what there is to say of a place
  BalanceBars* bars_;
  QLabel* pace_;
  QLabel* step_;
  QLabel* brightness_;
  QLabel* speed_;
  QPushButton* fastest_;
  QPushButton* forget_;
  QCheckBox* forces_;
  bool comes_to_sight_ = false;  // once its new size is known
  QMetaObject::Connection changed_;
  QMetaObject::Connection wanted_;
};

}  // namespace tidemark::ui
