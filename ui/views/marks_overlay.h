// Strokes, walls and anchors as slices show them.
#pragma once

#include <QLineF>
#include <QList>
#include <QPainter>
#include <QPainterPath>
#include <memory>

#include "engine/display.h"
#include "engine/slice_slab.h"
#include "ui/views/view_geometry.h"

namespace tidemark::ui {

// Orange and blue mean what they do in the speed map: the surface grows here, and here it does not.
inline constexpr QColor kInsideStroke(255, 150, 40);
inline constexpr QColor kOutsideStroke(90, 170, 255);

// Voxels of one kind in a slice, in mm along the slice's right (x) and up (y) from the patient's origin.
struct MarkedArea {
  QPainterPath area;
  QList<QLineF> border;
};
// Of offsets in the grid; those beside the slice are left out.
MarkedArea area_in_slice(const Geometry& geometry, const engine::SliceSlab& slab,
                         const renderer::SliceOrientation& orientation,
                         const std::vector<std::int64_t>& voxels);

// Kinds differ by their filling, too, for colour-blind eyes and grey prints: inside is filled, outside
// hatched one way, walls both ways, anchors dotted.
class MarksOverlay {
 public:
  void paint(QPainter& painter, const engine::DrawnMarks& marks, const Geometry& geometry,
             const renderer::SliceOrientation& orientation, glm::dvec3 position_mm,
             const SliceScreen& screen);

 private:
  void find(const Geometry& geometry, const renderer::SliceOrientation& orientation, glm::dvec3 position_mm);

  // As of what was last painted.
  engine::DrawnMarks marks_;
  renderer::SliceOrientation orientation_;
  double along_normal_mm_ = 0.0;
  MarkedArea inside_;
  MarkedArea outside_;
  MarkedArea walls_;
  MarkedArea anchors_;
};

}  // namespace tidemark::ui
