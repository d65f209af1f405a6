#include "ui/views/marks_overlay.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <tuple>

namespace tidemark::ui {
namespace {

// A voxel by its place on the slice's two axes and the third.
struct Cell {
  std::int64_t row = 0;
  std::int64_t column = 0;
  std::int64_t layer = 0;

  // NOLINTNEXTLINE(modernize-use-nullptr): clang-tidy 14 takes the comparison for one
  auto operator<=>(const Cell&) const = default;
};

// From cells to the slice's right and up.
class CellScreen {
 public:
  CellScreen(const Geometry& geometry, const std::array<int, 3>& axes,
             const renderer::SliceOrientation& orientation) {
    const auto place = [&](glm::dvec3 mm) {
      return QPointF(glm::dot(mm, orientation.right), glm::dot(mm, orientation.up));
    };
    const auto along = [&](int axis) { return place(geometry.direction[axis] * geometry.spacing_mm[axis]); };
    zero_ = place(geometry.origin_mm);
    column_ = along(axes[0]);
    row_ = along(axes[1]);
    layer_ = along(axes[2]);
  }
  [[nodiscard]] QPointF at(const Cell& cell, double column, double row) const {
    return zero_ + column_ * (static_cast<double>(cell.column) + column) +
           row_ * (static_cast<double>(cell.row) + row) + layer_ * static_cast<double>(cell.layer);
  }

 private:
  QPointF zero_, column_, row_, layer_;
};

// One of a column of layers is enough: a tilted slice meets several.
std::vector<Cell> cells_in(const Geometry& geometry, const engine::SliceSlab& slab,
                           const std::vector<std::int64_t>& voxels) {
  const std::array<int, 3>& axes = slab.axes();
  std::vector<Cell> cells;
  for (const std::int64_t offset : voxels) {
    const Index3 voxel = geometry.voxel_at(offset);
    if (slab.contains(voxel)) cells.push_back({voxel[axes[1]], voxel[axes[0]], voxel[axes[2]]});
  }
  std::ranges::sort(cells);
  const auto same = [](const Cell& a, const Cell& b) { return a.row == b.row && a.column == b.column; };
  cells.erase(std::unique(cells.begin(), cells.end(), same), cells.end());
  return cells;
}

std::vector<std::int64_t> constrained(const solver::Constraints& constraints, const Geometry& geometry,
                                      const engine::SliceSlab& slab, solver::Constraint what) {
  const PageLayout& layout = constraints.layout();
  std::vector<std::int64_t> voxels;
  for (const std::int64_t page : constraints.pages().stored_pages()) {
    const Index3 first = layout.first_voxel(page);
    if (!slab.meets(first, Index3(8))) continue;
    for (int place = 0; place < solver::Constraints::kPageVoxels; ++place) {
      if (constraints.page(page)[place] != what) continue;
      const Index3 voxel = first + Index3(place % 8, place / 8 % 8, place / 64);
      if (geometry.contains(voxel) && slab.contains(voxel)) voxels.push_back(geometry.offset(voxel));
    }
  }
  return voxels;
}

struct MarkStyle {
  QColor colour;
  Qt::BrushStyle filling;
  Qt::PenStyle border;
};
const MarkStyle kInside{kInsideStroke, Qt::SolidPattern, Qt::SolidLine};
const MarkStyle kOutside{kOutsideStroke, Qt::BDiagPattern, Qt::DashLine};
const MarkStyle kWall{QColor(255, 90, 90), Qt::DiagCrossPattern, Qt::SolidLine};
const MarkStyle kAnchor{QColor(120, 230, 130), Qt::Dense6Pattern, Qt::DotLine};

void paint_area(QPainter& painter, const MarkedArea& area, const QTransform& to_screen,
                const MarkStyle& style) {
  if (area.area.isEmpty()) return;
  QColor filling = style.colour;
  if (style.filling == Qt::SolidPattern) filling.setAlpha(110);
  painter.setPen(Qt::NoPen);
  painter.setBrush(QBrush(filling, style.filling));
  painter.drawPath(to_screen.map(area.area));
  QList<QLineF> border;
  border.reserve(area.border.size());
  for (const QLineF& line : area.border) border << to_screen.map(line);
  painter.setPen(QPen(QColor(0, 0, 0, 150), 3.0));
  painter.drawLines(border);
  painter.setPen(QPen(style.colour, 1.4, style.border));
  painter.drawLines(border);
}

}  // namespace

MarkedArea area_in_slice(const Geometry& geometry, const engine::SliceSlab& slab,
                         const renderer::SliceOrientation& orientation,
                         const std::vector<std::int64_t>& voxels) {
  const std::vector<Cell> cells = cells_in(geometry, slab, voxels);
  const CellScreen screen(geometry, slab.axes(), orientation);
  const auto has = [&](std::int64_t row, std::int64_t column) {
    const auto found = std::ranges::lower_bound(
        cells, std::pair(row, column), {}, [](const Cell& cell) { return std::pair(cell.row, cell.column); });
    return found != cells.end() && found->row == row && found->column == column;
  };
  MarkedArea found;
  found.area.setFillRule(Qt::WindingFill);
  for (std::size_t first = 0; first < cells.size();) {
    // A run of cells in a row is one piece.
    std::size_t end = first + 1;
    while (end < cells.size() && cells[end].row == cells[first].row &&
           cells[end].layer == cells[first].layer && cells[end].column == cells[end - 1].column + 1)
      ++end;
    const Cell& last = cells[end - 1];
    found.area.addPolygon(QPolygonF({screen.at(cells[first], -0.5, -0.5), screen.at(last, 0.5, -0.5),
                                     screen.at(last, 0.5, 0.5), screen.at(cells[first], -0.5, 0.5)}));
    found.area.closeSubpath();
    first = end;
  }
  for (const Cell& cell : cells) {
    const auto border = [&](double from_column, double from_row, double to_column, double to_row) {
      found.border << QLineF(screen.at(cell, from_column, from_row), screen.at(cell, to_column, to_row));
    };
    if (!has(cell.row - 1, cell.column)) border(-0.5, -0.5, 0.5, -0.5);
    if (!has(cell.row + 1, cell.column)) border(-0.5, 0.5, 0.5, 0.5);
    if (!has(cell.row, cell.column - 1)) border(-0.5, -0.5, -0.5, 0.5);
    if (!has(cell.row, cell.column + 1)) border(0.5, -0.5, 0.5, 0.5);
  }
  return found;
}

void MarksOverlay::find(const Geometry& geometry, const renderer::SliceOrientation& orientation,
                        glm::dvec3 position_mm) {
  const engine::SliceSlab slab(geometry, position_mm, orientation.into());
  static const std::vector<std::int64_t> kNone;
  const auto area = [&](const std::vector<std::int64_t>& voxels) {
    return area_in_slice(geometry, slab, orientation, voxels);
  };
  inside_ = area(marks_.strokes ? marks_.strokes->inside : kNone);
  outside_ = area(marks_.strokes ? marks_.strokes->outside : kNone);
  const auto of = [&](solver::Constraint what) {
    return marks_.constraints ? area(constrained(*marks_.constraints, geometry, slab, what)) : MarkedArea();
  };
  walls_ = of(solver::Constraint::wall);
  anchors_ = of(solver::Constraint::anchor);
}

void MarksOverlay::paint(QPainter& painter, const engine::DrawnMarks& marks, const Geometry& geometry,
                         const renderer::SliceOrientation& orientation, glm::dvec3 position_mm,
                         const SliceScreen& screen) {
  if (!marks.strokes && !marks.constraints) {
    marks_ = {};
    return;
  }
  const double along_normal_mm = glm::dot(position_mm, orientation.into());
  if (marks != marks_ || orientation != orientation_ || along_normal_mm != along_normal_mm_) {
    marks_ = marks;
    orientation_ = orientation;
    along_normal_mm_ = along_normal_mm;
    find(geometry, orientation, position_mm);
  }
  const QPointF zero = screen.position_of(glm::dvec3(0.0));
  const double scale = 1.0 / screen.mm_per_pixel();
  const QTransform to_screen(scale, 0.0, 0.0, -scale, zero.x(), zero.y());
  paint_area(painter, walls_, to_screen, kWall);
  paint_area(painter, anchors_, to_screen, kAnchor);
  paint_area(painter, outside_, to_screen, kOutside);
  paint_area(painter, inside_, to_screen, kInside);
}

}  // namespace tidemark::ui
