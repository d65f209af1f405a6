// The choice of an axis of a sweep: a parameter, its first value, its last, and how many.
#pragma once

#include <QWidget>
#include <optional>

#include "document/sweep_axis.h"
#include "solver/parameters.h"
#include "solver/speed/speed_setting.h"

class QComboBox;

namespace tidemark::ui {

class NumberBox;

class SweepAxisChoice : public QWidget {
  Q_OBJECT
 public:
  // `name`: of the axis, for assistive technologies. With `optional` there may be none.
  SweepAxisChoice(const QString& name, bool optional, QWidget* parent = nullptr);

  // The parameters that can be swept; a chosen one that is still among them stays, with its values.
  void set_setting(const solver::SpeedSetting& setting);
  // A parameter with values around its present one.
  void suggest(const std::string& parameter, const solver::Parameters& parameters);
  void show_axis(const std::optional<document::SweepAxis>& axis);
  [[nodiscard]] std::optional<document::SweepAxis> axis() const;  // as it is chosen, perhaps a bad one

 signals:
  // Another parameter was chosen: values have to be suggested.
  void parameter_chosen(const QString& parameter);

 private:
  void enable_numbers();
  [[nodiscard]] int count() const;

  QComboBox* parameter_;
  NumberBox* from_;
  NumberBox* to_;
  NumberBox* count_;
  bool optional_;
  solver::SpeedSetting setting_;
};

// A parameter of sweep_parameters() for people.
[[nodiscard]] QString sweep_parameter_text(const std::string& parameter);

}  // namespace tidemark::ui
