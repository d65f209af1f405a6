// The curves of the evolution: volume, area, motion and agreement over its steps, and what mathematics says.
#pragma once

#include "ui/panels/case_widget.h"

class QLabel;

namespace tidemark::engine {
class CasePrediction;
}

namespace tidemark::ui {

class CurveLegend;
class CurvePlot;

class EvolutionCurves : public CaseWidget {
  Q_OBJECT
 public:
  explicit EvolutionCurves(QWidget* parent = nullptr);

 protected:
  void attach() override;
  void refresh() override;

 private:
  void show_measured();
  void show_predicted();
  void show_steps();

  engine::CasePrediction* prediction_;
  QWidget* predicted_part_;  // where there is a law
  CurveLegend* legend_;
  QLabel* radius_;
  CurvePlot* volume_;
  CurvePlot* area_;
  CurvePlot* motion_;
  CurvePlot* dice_;
};

}  // namespace tidemark::ui
