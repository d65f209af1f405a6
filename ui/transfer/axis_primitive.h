// The common form of primitives of the source and of the surface, for widgets that edit either.
#pragma once

#include <QColor>
#include <QString>
#include <array>
#include <vector>

#include "renderer/transfer_function.h"

namespace tidemark::ui {

// An axis of a transfer function, as people see it.
struct PrimitiveAxis {
  QString name;      // "Value"
  QString unit;      // "HU"; empty: none is known
  double low = 0.0;  // the smallest extent of a plot
  double high = 1.0;
  QString greyed;  // why the axis has no effect now, a sentence; empty: it has
};

// The factors are in the order of the list's axes: value, gradient, phi; or intensity, distance.
struct AxisPrimitive {
  std::array<renderer::TransferFactor, 3> factors;
  double opacity = 1.0;
  glm::vec3 colour{1.0F};

  bool operator==(const AxisPrimitive&) const = default;
};

enum class PrimitiveKind { source, surface };

std::vector<AxisPrimitive> primitives_of(const renderer::TransferFunction& function, PrimitiveKind kind);
void set_primitives(renderer::TransferFunction& function, PrimitiveKind kind,
                    const std::vector<AxisPrimitive>& primitives);

// "Gaussian 230 ± 50 HU, gradient 10 → 50 HU/mm"
QString describe(const AxisPrimitive& primitive, const std::vector<PrimitiveAxis>& axes);

// A factor of this kind in the middle of the axis.
renderer::TransferFactor middle_factor(renderer::TransferFactor::Kind kind, const PrimitiveAxis& axis);

// A colour that the others have not, as far as there are enough.
glm::vec3 next_colour(const std::vector<AxisPrimitive>& others);

QColor to_qcolor(const glm::vec3& colour);

}  // namespace tidemark::ui
