#include "ui/opening/grid_text.h"

#include <QCoreApplication>

#include "ui/widgets/number_text.h"

namespace tidemark::ui {

QString size_text(const Geometry& geometry) {
  return QStringLiteral("%1 × %2 × %3").arg(geometry.size.x).arg(geometry.size.y).arg(geometry.size.z);
}

QString spacing_text(const Geometry& geometry) {
  const auto number = [](double mm) { return general_text(mm, 3); };
  const glm::dvec3& spacing = geometry.spacing_mm;
  return QStringLiteral("%1 × %2 × %3").arg(number(spacing.x), number(spacing.y), number(spacing.z));
}

QString grid_text(const Geometry& geometry) {
  return QCoreApplication::translate("tidemark::GridText", "%1 voxels of %2 mm")
      .arg(size_text(geometry), spacing_text(geometry));
}

}  // namespace tidemark::ui
