// The controls of the speed: T, epsilon and alpha (paper section 6.1), and the terms that take part.
#pragma once

#include <functional>

#include "ui/panels/case_widget.h"

class QCheckBox;
class QLabel;

namespace tidemark {

class Form;
class SliderNumber;
class SpeedPlot;

class SpeedControls : public CaseWidget {
  Q_OBJECT
 public:
  explicit SpeedControls(QWidget* parent = nullptr);

 protected:
  void attach() override;
  void refresh() override;

 private:
  void add_numbers(Form& form);
  void add_terms(Form& form);
  void change(const std::function<void(Parameters&)>& apply, std::uint64_t gesture);

  SpeedPlot* tent_;
  SliderNumber* target_;
  SliderNumber* range_;
  SliderNumber* alpha_;
  QLabel* paper_alpha_;
  QCheckBox* data_term_;
  QCheckBox* curvature_term_;
  QCheckBox* rescaling_term_;
};

}  // namespace tidemark
