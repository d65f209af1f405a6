// The figures of the evolution: curves over its steps, and numbers.
#pragma once

#include "ui/panels/case_widget.h"

class QLabel;

namespace tidemark {

class CurvePlot;

class EvolutionFigures : public CaseWidget {
  Q_OBJECT
 public:
  explicit EvolutionFigures(QWidget* parent = nullptr);

 protected:
  void attach() override;
  void refresh() override;

 private:
  void show_curves();

  CurvePlot* volume_;
  CurvePlot* area_;
  CurvePlot* motion_;
  QLabel* step_;
  QLabel* pages_;
  QLabel* bytes_;
  QLabel* pace_;
};

}  // namespace tidemark
