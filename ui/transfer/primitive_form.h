// A primitive in exact numbers, and its colour.
#pragma once

#include <QLabel>
#include <QPointer>
#include <QPushButton>
#include <optional>

#include "ui/transfer/factor_editor.h"

class QColorDialog;

namespace tidemark::ui {

class PrimitiveForm : public QWidget {
  Q_OBJECT
 public:
  PrimitiveForm(PrimitiveKind kind, int axes, QWidget* parent = nullptr);

  void set_axes(const std::vector<PrimitiveAxis>& axes);
  // Emits nothing. Without a primitive the form is empty.
  void set_primitive(const std::optional<AxisPrimitive>& primitive);

  [[nodiscard]] FactorEditor* factor(int axis) const { return factors_[static_cast<std::size_t>(axis)]; }
  [[nodiscard]] NumberBox* opacity_box() const { return opacity_; }
  [[nodiscard]] QPushButton* colour_button() const { return colour_; }

 signals:
  void edited(const tidemark::ui::AxisPrimitive& primitive);

 private:
  void choose_colour();
  void take_colour(const glm::vec3& colour);

  AxisPrimitive primitive_;
  std::vector<QLabel*> names_;
  std::vector<FactorEditor*> factors_;
  NumberBox* opacity_;
  QPushButton* colour_;
  QPointer<QColorDialog> dialog_;
};

}  // namespace tidemark::ui
