// One speed function with its numbers, as the registry describes them.
#pragma once

#include <QWidget>
#include <cstdint>
#include <functional>
#include <vector>

#include "solver/speed/speed_registry.h"

class QComboBox;
class QLabel;
class QToolButton;

namespace tidemark::ui {

class Form;

class TermControls : public QWidget {
  Q_OBJECT
 public:
  // `title`: the row's label. One of several can be removed.
  TermControls(const QString& title, const solver::SpeedKind& kind, bool removable,
               QWidget* parent = nullptr);

  [[nodiscard]] const solver::SpeedKind& kind() const { return *kind_; }
  void set_values(const std::map<std::string, double>& values);

 signals:
  void function_chosen(const QString& function);
  void number_edited(const QString& name, double value, std::uint64_t gesture);
  void remove_wanted();

 private:
  void add_choice(Form& form, const QString& title, bool removable);
  void add_numbers(Form& form);
  void add_number(Form& form, const solver::SpeedParameter& parameter);
  void add_words(Form& form, const solver::SpeedParameter& parameter);

  const solver::SpeedKind* kind_;
  QComboBox* choice_;
  std::vector<std::function<void(double)>> show_;  // the value of each of the kind's parameters
};

}  // namespace tidemark::ui
