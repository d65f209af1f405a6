// The figures of the evolution: curves over its steps, sizes, and the agreement with a known answer.
#pragma once

#include "ui/panels/case_widget.h"

class QCheckBox;
class QLabel;

namespace tidemark::ui {

class CurvePlot;
class Form;

class EvolutionFigures : public CaseWidget {
  Q_OBJECT
 public:
  explicit EvolutionFigures(QWidget* parent = nullptr);

 protected:
  void attach() override;
  void refresh() override;

 private:
  void add_curves(Form& form);
  void add_details(Form& form);
  void show_curves();

  CurvePlot* volume_;
  CurvePlot* area_;
  CurvePlot* motion_;
  QLabel* step_;
  QWidget* dice_part_;  // for phantoms
  QLabel* dice_;
  QCheckBox* truth_;
  QLabel* pages_;
  QLabel* bytes_;
  QLabel* pace_;
};

}  // namespace tidemark::ui
