// The seldom changed part of the speed: its terms, its discretisation, and the rescaling term's numbers
// (paper sections 2.1 and 4.2).
#pragma once

#include <functional>

#include "ui/panels/case_widget.h"

class QCheckBox;
class QComboBox;
class QLabel;

namespace tidemark::ui {

class Form;
class SliderNumber;

class SpeedDetails : public CaseWidget {
  Q_OBJECT
 public:
  explicit SpeedDetails(QWidget* parent = nullptr);

 protected:
  void refresh() override;

 private:
  void add_terms(Form& form);
  void add_scheme(Form& form);
  void change(const std::function<void(solver::Parameters&)>& apply, std::uint64_t gesture);
  [[nodiscard]] double rescaling_weight() const;  // also where the band decides

  QLabel* paper_alpha_;
  QCheckBox* data_term_;
  QCheckBox* curvature_term_;
  QCheckBox* rescaling_term_;
  QComboBox* scheme_;
  SliderNumber* rescale_;
  QCheckBox* rescale_by_band_;
  SliderNumber* target_gradient_;
};

}  // namespace tidemark::ui
