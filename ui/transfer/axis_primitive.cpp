#include "ui/transfer/axis_primitive.h"

#include <QStringList>
#include <algorithm>

#include "ui/widgets/number_text.h"
#include "ui/widgets/tr.h"

namespace tidemark::ui {
namespace {

QString number(double value) {
  return general_text(value, 4);
}

QString describe_factor(const renderer::TransferFactor& factor, const QString& unit) {
  const QString form = factor.kind == renderer::TransferFactor::Kind::gaussian ? QStringLiteral("%1 ± %2")
                                                                               : QStringLiteral("%1 → %2");
  const QString text = form.arg(number(factor.start), number(factor.end));
  return unit.isEmpty() ? text : text + QChar(0x00A0) + unit;
}

}  // namespace

std::vector<AxisPrimitive> primitives_of(const renderer::TransferFunction& function, PrimitiveKind kind) {
  std::vector<AxisPrimitive> primitives;
  if (kind == PrimitiveKind::source) {
    for (const renderer::SourcePrimitive& p : function.source) {
      primitives.push_back({{p.value, p.gradient, p.phi}, p.opacity, p.colour});
    }
  } else {
    for (const renderer::SurfacePrimitive& p : function.surface) {
      primitives.push_back({{p.intensity, p.distance, {}}, p.opacity, p.colour});
    }
  }
  return primitives;
}

void set_primitives(renderer::TransferFunction& function, PrimitiveKind kind,
                    const std::vector<AxisPrimitive>& primitives) {
  if (kind == PrimitiveKind::source) {
    function.source.clear();
    for (const AxisPrimitive& p : primitives) {
      function.source.push_back({p.factors[0], p.factors[1], p.factors[2], p.opacity, p.colour});
    }
  } else {
    function.surface.clear();
    for (const AxisPrimitive& p : primitives) {
      function.surface.push_back({p.factors[0], p.factors[1], p.opacity, p.colour});
    }
  }
}

QString describe(const AxisPrimitive& primitive, const std::vector<PrimitiveAxis>& axes) {
  QStringList parts;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const renderer::TransferFactor& factor = primitive.factors[i];
    if (factor.kind == renderer::TransferFactor::Kind::everything) continue;
    const QString text = describe_factor(factor, axes[i].unit);
    if (!parts.isEmpty() || i > 0) {
      parts << axes[i].name.toLower() + ' ' + text;
    } else {
      parts << (factor.kind == renderer::TransferFactor::Kind::gaussian ? tr("Gaussian %1") : tr("Ramp %1"))
                   .arg(text);
    }
  }
  if (parts.isEmpty()) return tr("Everything");
  QString text = parts.join(QStringLiteral(", "));
  text[0] = text[0].toUpper();
  return text;
}

renderer::TransferFactor middle_factor(renderer::TransferFactor::Kind kind, const PrimitiveAxis& axis) {
  const double extent = axis.high - axis.low;
  switch (kind) {
    case renderer::TransferFactor::Kind::gaussian:
      return {kind, axis.low + 0.5 * extent, 0.1 * extent};
    case renderer::TransferFactor::Kind::ramp:
      return {kind, axis.low + 0.4 * extent, axis.low + 0.6 * extent};
    case renderer::TransferFactor::Kind::everything:
      break;
  }
  return {};
}

glm::vec3 next_colour(const std::vector<AxisPrimitive>& others) {
  // Okabe and Ito's colours, which are told apart with any kind of colour vision.
  static const glm::vec3 kColours[] = {{0.90F, 0.62F, 0.00F}, {0.34F, 0.71F, 0.91F}, {0.00F, 0.62F, 0.45F},
                                       {0.94F, 0.89F, 0.26F}, {0.00F, 0.45F, 0.70F}, {0.84F, 0.37F, 0.00F},
                                       {0.80F, 0.47F, 0.65F}};
  for (const glm::vec3& colour : kColours) {
    const auto has = [&](const AxisPrimitive& p) { return p.colour == colour; };
    if (std::none_of(others.begin(), others.end(), has)) return colour;
  }
  return kColours[others.size() % std::size(kColours)];
}

QColor to_qcolor(const glm::vec3& colour) {
  return QColor::fromRgbF(colour.r, colour.g, colour.b);
}

}  // namespace tidemark::ui
