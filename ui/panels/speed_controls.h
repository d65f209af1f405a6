// What steers the surface: T, epsilon and alpha (paper section 6.1).
#pragma once

#include <functional>

#include "ui/panels/case_widget.h"

namespace tidemark::ui {

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
  void change(const std::function<void(solver::Parameters&)>& apply, std::uint64_t gesture);

  SpeedPlot* tent_;
  SliderNumber* target_;
  SliderNumber* range_;
  SliderNumber* alpha_;
};

}  // namespace tidemark::ui
