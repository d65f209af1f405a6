// Places the surface from which the level set begins.
#pragma once

#include <vector>

#include "ui/panels/panel.h"

class QCheckBox;
class QComboBox;
class QLabel;
class QPushButton;

namespace tidemark::ui {

class StartMethod;

class InitialisePanel : public Panel {
  Q_OBJECT
 public:
  explicit InitialisePanel(QWidget* parent = nullptr);

 protected:
  void attach() override;
  void refresh() override;

 private:
  void add_methods();
  void add_start();
  void show_method(int index);
  void show_sentence();
  // That the chosen method can have in the case; the raw tent has no coarser ones, and those of a small study
  // are not worth their while.
  [[nodiscard]] int levels() const;

  std::vector<StartMethod*> methods_;
  int method_ = 0;
  QComboBox* from_;
  QCheckBox* coarse_to_fine_;
  QLabel* sentence_;
  QLabel* replaces_;
  QLabel* problem_;
  QPushButton* start_;
};

}  // namespace tidemark::ui
