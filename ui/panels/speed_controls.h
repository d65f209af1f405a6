// The controls of T, epsilon and alpha (paper section 6.1). T and epsilon are the tent's.
#pragma once

#include "engine/case_proxy.h"
#include "ui/panels/case_widget.h"

class QFormLayout;

namespace tidemark::ui {

class Form;
class SliderNumber;
class JointPlot;
class SpeedHistogram;
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
  void show_mark();
  void change(const engine::CaseProxy::ParameterChange& apply, std::uint64_t gesture);

  QFormLayout* form_;
  SpeedPlot* tent_;
  SpeedHistogram* certainty_;
  JointPlot* joint_;
  SliderNumber* target_;
  SliderNumber* range_;
  SliderNumber* alpha_;
  QMetaObject::Connection explained_;
};

}  // namespace tidemark::ui
