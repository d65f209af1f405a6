// The fold "Gradient of φ": whether rescaling holds |grad phi| at its target.
#pragma once

#include <memory>

#include "engine/newest_question.h"
#include "solver/gradient_histogram.h"
#include "ui/panels/case_widget.h"

class QLabel;

namespace tidemark::ui {

class Disclosure;
class GradientPlot;

// While it is folded or hidden nothing is computed.
class GradientFigures : public CaseWidget {
  Q_OBJECT
 public:
  explicit GradientFigures(QWidget* parent = nullptr);

 protected:
  void attach() override;
  void refresh() override;

 private:
  struct Question {
    std::shared_ptr<const solver::Field> phi;
    double highest = 2.0;

    bool operator==(const Question&) const = default;
  };
  using Answer = std::optional<solver::GradientHistogram>;
  void show_answer();

  Disclosure* fold_;
  GradientPlot* plot_;
  QLabel* near_;
  QLabel* band_;
  engine::NewestQuestion<Question, Answer> question_;
};

}  // namespace tidemark::ui
