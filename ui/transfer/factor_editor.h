// A factor in exact numbers: its kind, and the two numbers that define it.
#pragma once

#include <QComboBox>
#include <QWidget>

#include "ui/transfer/axis_primitive.h"
#include "ui/widgets/number_box.h"

namespace tidemark::ui {

class FactorEditor : public QWidget {
  Q_OBJECT
 public:
  explicit FactorEditor(QWidget* parent = nullptr);

  void set_axis(const PrimitiveAxis& axis);
  void set_factor(const renderer::TransferFactor& factor);  // emits nothing

  [[nodiscard]] QComboBox* kind_box() const { return kind_; }
  [[nodiscard]] NumberBox* start_box() const { return start_; }
  [[nodiscard]] NumberBox* end_box() const { return end_; }

 signals:
  void edited(const tidemark::renderer::TransferFactor& factor);

 private:
  void take_kind();
  void take_numbers();
  [[nodiscard]] double smallest() const;

  PrimitiveAxis axis_;
  renderer::TransferFactor factor_;
  QComboBox* kind_;
  NumberBox* start_;
  NumberBox* end_;
};

// A box for numbers of about this size: as many decimals as make a thousandth of it.
void suit_decimals(NumberBox& box, double extent);
// Shows a number that changed elsewhere; if it did not, text that is being typed stays.
void show_number(NumberBox& box, double value);

}  // namespace tidemark::ui
