#include "ui/views/slice_outline.h"

namespace tidemark::ui {

void paint_outline(QPainter& painter, const QList<QLineF>& lines, const SliceScreen& screen,
                   const QColor& colour) {
  const QPointF zero = screen.position_of(glm::dvec3(0.0));
  const double scale = 1.0 / screen.mm_per_pixel();
  const auto to_screen = [&](QPointF mm) { return zero + QPointF(mm.x() * scale, -mm.y() * scale); };
  QList<QLineF> on_screen;
  on_screen.reserve(lines.size());
  for (const QLineF& line : lines) on_screen << QLineF(to_screen(line.p1()), to_screen(line.p2()));
  paint_fine_lines(painter, on_screen, colour);
}

}  // namespace tidemark::ui
