// A factor in exact numbers: its kind, and the two numbers that define it.
#pragma once

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QWidget>

#include "ui/transfer/axis_primitive.h"

namespace tidemark {

class FactorEditor : public QWidget {
  Q_OBJECT
 public:
  explicit FactorEditor(QWidget* parent = nullptr);

  void set_axis(const PrimitiveAxis& axis);
  void set_factor(const TransferFactor& factor);  // emits nothing

  [[nodiscard]] QComboBox* kind_box() const { return kind_; }
  [[nodiscard]] QDoubleSpinBox* start_box() const { return start_; }
  [[nodiscard]] QDoubleSpinBox* end_box() const { return end_; }

 signals:
  void edited(const tidemark::TransferFactor& factor);

 private:
  void take_kind();
  void take_numbers();
  [[nodiscard]] double smallest() const;

  PrimitiveAxis axis_;
  TransferFactor factor_;
  QComboBox* kind_;
  QDoubleSpinBox* start_;
  QDoubleSpinBox* end_;
};

// A box for numbers of about this size: as many decimals as make a thousandth of it.
void suit_decimals(QDoubleSpinBox& box, double extent);
// Shows a number that changed elsewhere; if it did not, text that is being typed stays.
void show_number(QDoubleSpinBox& box, double value);

}  // namespace tidemark
