// The edges of the volume as a 3D view shows them.
#pragma once

#include <QPainter>
#include <vector>

#include "ui/views/view_geometry.h"

namespace tidemark::ui {

struct BoxEdge {
  QPointF from;
  QPointF to;
  bool hidden = false;  // behind everything that is in the volume
};
std::vector<BoxEdge> box_edges(const Geometry& geometry, const VolumeScreen& screen);

// Faint; hidden edges fainter.
void paint_volume_box(QPainter& painter, const Geometry& geometry, const VolumeScreen& screen);

}  // namespace tidemark::ui
