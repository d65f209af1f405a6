// The figures of the evolution: steps, sizes, and the agreement with a known answer.
#pragma once

#include "ui/panels/case_widget.h"

class QCheckBox;
class QLabel;

namespace tidemark::engine {
class TruthComparison;
}

namespace tidemark::ui {

class Form;

class EvolutionFigures : public CaseWidget {
  Q_OBJECT
 public:
  explicit EvolutionFigures(QWidget* parent = nullptr);

 protected:
  void attach() override;
  void refresh() override;

 private:
  void add_details(Form& form);
  void show_distances();

  QLabel* step_;
  QLabel* moves_;
  QWidget* dice_part_;  // for phantoms
  QLabel* dice_;
  QLabel* mean_distance_;
  QLabel* most_distance_;
  engine::TruthComparison* comparison_;
  QCheckBox* truth_;
  QCheckBox* truth_error_;
  QLabel* pages_;
  QLabel* bytes_;
  QLabel* pace_;
};

}  // namespace tidemark::ui
