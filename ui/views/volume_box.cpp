#include "ui/views/volume_box.h"

#include <array>
#include <glm/geometric.hpp>

namespace tidemark::ui {

std::vector<BoxEdge> box_edges(const Geometry& geometry, const VolumeScreen& screen) {
  const std::array<glm::dvec3, 8> corners = corners_of_box(geometry);
  // Of the face on the corner's side of an axis.
  const auto faces_viewer = [&](std::size_t corner, int axis) {
    const double outward = (corner >> axis & 1U) != 0 ? 1.0 : -1.0;
    return outward * glm::dot(geometry.direction[axis], screen.into()) < 0.0;
  };
  std::vector<BoxEdge> edges;
  for (std::size_t corner = 0; corner < corners.size(); ++corner) {
    for (int axis = 0; axis < 3; ++axis) {
      const std::size_t other = corner | std::size_t{1} << axis;
      if (other == corner) continue;
      edges.push_back({screen.position_of(corners[corner]), screen.position_of(corners[other]),
                       !faces_viewer(corner, (axis + 1) % 3) && !faces_viewer(corner, (axis + 2) % 3)});
    }
  }
  return edges;
}

void paint_volume_box(QPainter& painter, const Geometry& geometry, const VolumeScreen& screen) {
  for (const BoxEdge& edge : box_edges(geometry, screen)) {
    painter.setPen(QPen(QColor(170, 180, 200, edge.hidden ? 45 : 120), 1.0));
    painter.drawLine(edge.from, edge.to);
  }
}

}  // namespace tidemark::ui
