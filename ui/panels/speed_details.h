// The seldom changed part of the speed: its terms, its discretisation, the band, and the rescaling term's
// numbers (paper sections 2.1, 4.2 and 6.1).
#pragma once

#include "engine/case_proxy.h"
#include "ui/panels/case_widget.h"

class QCheckBox;
class QComboBox;
class QLabel;

namespace tidemark::ui {

class Form;
class NumberBox;
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
  void add_band(Form& form);
  void add_rescaling(Form& form);
  void change(const engine::CaseProxy::ParameterChange& apply, std::uint64_t gesture);
  [[nodiscard]] double rescaling_weight() const;  // also where the band decides
  [[nodiscard]] double band() const;              // also where the spacing decides

  QLabel* paper_alpha_;
  QCheckBox* data_term_;
  QCheckBox* curvature_term_;
  QCheckBox* rescaling_term_;
  QComboBox* scheme_;
  QComboBox* data_form_;
  NumberBox* band_;
  QCheckBox* band_by_spacing_;
  SliderNumber* rescale_;
  QCheckBox* rescale_by_band_;
  SliderNumber* target_gradient_;
};

}  // namespace tidemark::ui
