#include "ui/views/orientation_cube.h"

#include <QPainterPath>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace tidemark::ui {
namespace {

constexpr double kEdge = 34.0;        // logical pixels
constexpr double kCubeMargin = 12.0;  // to the view's border
constexpr double kLeastView = 180.0;

// A side of the patient (LPS), and which way its letter stands.
struct Side {
  char letter;
  glm::dvec3 normal;
  glm::dvec3 up;
};
const glm::dvec3 kTowardsHead(0.0, 0.0, 1.0);
const Side kSides[] = {{'L', {1.0, 0.0, 0.0}, kTowardsHead},    {'R', {-1.0, 0.0, 0.0}, kTowardsHead},
                       {'P', {0.0, 1.0, 0.0}, kTowardsHead},    {'A', {0.0, -1.0, 0.0}, kTowardsHead},
                       {'H', {0.0, 0.0, 1.0}, {0.0, 1.0, 0.0}}, {'F', {0.0, 0.0, -1.0}, {0.0, -1.0, 0.0}}};

QPainterPath letter_on(const CubeFace& face, const QFont& font) {
  constexpr double kSide = 100.0;
  QFont large = font;
  large.setPixelSize(76);
  large.setBold(true);
  QPainterPath letter;
  letter.addText(0.0, 0.0, large, QString(QLatin1Char(face.letter)));
  letter.translate(QPointF(kSide / 2.0, kSide / 2.0) - letter.boundingRect().center());
  const QPolygonF square({QPointF(0, 0), QPointF(kSide, 0), QPointF(kSide, kSide), QPointF(0, kSide)});
  QTransform onto;
  return QTransform::quadToQuad(square, face.outline, onto) ? onto.map(letter) : QPainterPath();
}

}  // namespace

std::vector<CubeFace> cube_faces(const renderer::Camera& camera, QPointF centre, double edge) {
  constexpr double kLeastFacing = 0.02;
  const glm::dvec3 right = camera.right();
  const glm::dvec3 up = camera.up();
  const glm::dvec3 to_viewer = glm::cross(right, up);
  std::vector<CubeFace> faces;
  for (const Side& side : kSides) {
    const double facing = glm::dot(side.normal, to_viewer);
    if (facing < kLeastFacing) continue;
    const glm::dvec3 along = glm::cross(side.up, side.normal);  // to the right of the letter
    CubeFace face{side.letter, {}, facing};
    for (const auto& [x, y] : {std::pair(-1.0, 1.0), {1.0, 1.0}, {1.0, -1.0}, {-1.0, -1.0}}) {
      const glm::dvec3 corner = 0.5 * edge * (side.normal + x * along + y * side.up);
      face.outline << centre + QPointF(glm::dot(corner, right), -glm::dot(corner, up));
    }
    faces.push_back(std::move(face));
  }
  return faces;
}

void paint_orientation_cube(QPainter& painter, QSizeF view, const renderer::Camera& camera) {
  if (std::min(view.width(), view.height()) < kLeastView) return;
  const double reach = 0.5 * std::sqrt(3.0) * kEdge;
  const QPointF centre(kCubeMargin + reach, view.height() - kCubeMargin - reach);
  const QColor rim(16, 18, 22);
  for (const CubeFace& face : cube_faces(camera, centre, kEdge)) {
    const int grey = static_cast<int>(std::lround(120.0 + 110.0 * face.facing));
    painter.setPen(QPen(rim, 1.2, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
    painter.setBrush(QColor(grey, grey, std::min(grey + 6, 255)));
    painter.drawPolygon(face.outline);
    painter.fillPath(letter_on(face, painter.font()), rim);
  }
}

}  // namespace tidemark::ui
