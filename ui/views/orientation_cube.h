// A cube in a corner of a 3D view whose faces name the patient's sides, turned as the patient is.
#pragma once

#include <QPainter>
#include <vector>

#include "renderer/camera.h"

namespace tidemark::ui {

// A face that is seen.
struct CubeFace {
  char letter = 'A';    // R, L, A, P, H or F
  QPolygonF outline;    // its corners as the letter stands: top left, top right, bottom right, bottom left
  double facing = 1.0;  // 1 where it faces the viewer, 0 where it is seen from its edge
};
std::vector<CubeFace> cube_faces(const renderer::Camera& camera, QPointF centre, double edge);

// At the bottom left; nothing where the view has no room for it.
void paint_orientation_cube(QPainter& painter, QSizeF view, const renderer::Camera& camera);

}  // namespace tidemark::ui
