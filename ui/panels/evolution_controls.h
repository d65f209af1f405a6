// The controls of the evolution: buttons, steps a picture, pause at convergence, executor.
#pragma once

#include <array>

#include "ui/panels/case_widget.h"

class QAction;
class QCheckBox;
class QComboBox;
class QLabel;
class QToolButton;

namespace tidemark::ui {

class Form;
class SliderNumber;

// The main window's, so that buttons, menus and keys are one.
struct EvolutionActions {
  QAction* play = nullptr;  // and pause
  QAction* step = nullptr;
  QAction* step_back = nullptr;
  QAction* restart = nullptr;
};

class EvolutionControls : public CaseWidget {
  Q_OBJECT
 public:
  explicit EvolutionControls(QWidget* parent = nullptr);

  void set_actions(const EvolutionActions& actions);

 protected:
  void attach() override;
  void refresh() override;

 private:
  QLayout* make_buttons();
  void add_details(Form& form);
  void fill_executors();
  void set_leak_rule();

  std::array<QToolButton*, 4> buttons_{};  // restart, step back, play, step
  QLabel* state_;
  QComboBox* steps_;
  QCheckBox* pause_;
  QCheckBox* leaks_;
  SliderNumber* narrowing_;
  SliderNumber* pace_;
  QComboBox* executor_;
};

}  // namespace tidemark::ui
