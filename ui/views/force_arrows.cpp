#include "ui/views/force_arrows.h"

#include <QFontMetricsF>
#include <QLineF>
#include <QList>
#include <algorithm>
#include <cmath>

#include "ui/look/term_colours.h"
#include "ui/views/overlay.h"
#include "ui/widgets/number_text.h"
#include "ui/widgets/tr.h"

namespace tidemark::ui {
namespace {

constexpr double kLongestArrow = 34.0;  // logical pixels
constexpr double kShortest = 1.5;       // below it an arrow is not drawn
constexpr double kBeside = 3.5;         // between arrows of one place
constexpr double kArrowHead = 4.5;
const QColor kSumColour(250, 250, 250);

struct ArrowKind {
  QString name;
  QColor colour;
  double (*push)(const solver::Pushes&);
  double beside;  // of the normal, in steps of kBeside
  double width;
};

std::vector<ArrowKind> kinds(const std::vector<engine::PlaceForces>& forces) {
  std::vector<ArrowKind> kinds{
      {tr("data"), kDataColour, [](const solver::Pushes& p) { return p.data; }, -1.0, 1.6},
      {tr("curvature"), kCurvatureColour, [](const solver::Pushes& p) { return p.curvature; }, 1.0, 1.6}};
  const auto advects = [](const engine::PlaceForces& at) { return at.pushes.advection != 0.0; };
  if (std::any_of(forces.begin(), forces.end(), advects)) {
    kinds.push_back(
        {tr("advection"), kAdvectionColour, [](const solver::Pushes& p) { return p.advection; }, 2.0, 1.6});
  }
  kinds.push_back({tr("sum"), kSumColour, [](const solver::Pushes& p) { return p.sum(); }, 0.0, 2.2});
  return kinds;
}

// The next of 1, 2, 5, 10, ... times a power of ten, so that lengths keep their meaning while it moves.
double round_up(double value) {
  const double decade = std::pow(10.0, std::floor(std::log10(value)));
  for (const double step : {1.0, 2.0, 5.0}) {
    if (value <= step * decade) return step * decade;
  }
  return 10.0 * decade;
}

// What the longest arrow stands for: few places push harder.
double largest_push(const std::vector<engine::PlaceForces>& forces, const std::vector<ArrowKind>& kinds) {
  std::vector<double> pushes;
  for (const engine::PlaceForces& at : forces) {
    for (const ArrowKind& kind : kinds) pushes.push_back(std::abs(kind.push(at.pushes)));
  }
  if (pushes.empty()) return 0.0;
  const auto nearly_last = pushes.begin() + static_cast<std::ptrdiff_t>(pushes.size() * 19 / 20);
  std::nth_element(pushes.begin(), nearly_last, pushes.end());
  return *nearly_last;
}

void add_arrow(QList<QLineF>& lines, QPointF from, QPointF way) {
  const double length = std::hypot(way.x(), way.y());
  if (length < kShortest) return;
  const QPointF along = way / length;
  const QPointF across(-along.y(), along.x());
  const QPointF tip = from + way;
  const double head = std::min(kArrowHead, 0.6 * length);
  lines << QLineF(from, tip) << QLineF(tip, tip - along * head + across * (0.6 * head))
        << QLineF(tip, tip - along * head - across * (0.6 * head));
}

// All of one kind at once, and with caps that Qt paints quickly.
void paint_lines(QPainter& painter, const QList<QLineF>& lines, const QColor& colour, double width) {
  painter.setPen(QPen(QColor(0, 0, 0, 170), width + 1.5, Qt::SolidLine, Qt::SquareCap));
  painter.drawLines(lines);
  painter.setPen(QPen(colour, width, Qt::SolidLine, Qt::SquareCap));
  painter.drawLines(lines);
}

// The outward normal as the view shows it: of length 1 where it lies in the picture.
QPointF on_screen(const SurfaceScreen& screen, glm::dvec3 place_mm, glm::dvec3 outward) {
  return (screen.position_of(place_mm + outward) - screen.position_of(place_mm)) * screen.mm_per_pixel;
}

// At the right, above the scale bar.
void paint_key(QPainter& painter, const std::vector<ArrowKind>& kinds, double largest_mm, QSizeF size) {
  constexpr double kMargin = 12.0;
  constexpr double kScaleBar = 40.0;
  constexpr double kDash = 16.0;
  const double line = QFontMetricsF(painter.font()).height() + 3.0;
  const QRectF rows(0.0, 0.0, size.width() - kMargin, line);
  double y = size.height() - kScaleBar - line;
  const auto paint_row = [&](const QString& text) {
    paint_text(painter, rows.translated(0.0, y), Qt::AlignRight | Qt::AlignVCenter, text);
  };
  paint_row(tr("longest: %1 mm per unit of time").arg(short_text(largest_mm, 2)));
  const QFontMetricsF metrics(painter.font());
  for (auto kind = kinds.rbegin(); kind != kinds.rend(); ++kind) {
    y -= line;
    paint_row(kind->name);
    const double right = rows.right() - metrics.horizontalAdvance(kind->name) - 8.0;
    const double middle = y + 0.5 * line;
    paint_lines(painter, {QLineF(right - kDash, middle, right, middle)}, kind->colour, kind->width);
  }
}

}  // namespace

void paint_forces(QPainter& painter, const std::vector<engine::PlaceForces>& forces, double spacing_mm,
                  const SurfaceScreen& screen) {
  const std::vector<ArrowKind> drawn = kinds(forces);
  const double most = largest_push(forces, drawn);
  if (most <= 0.0) return;
  const double longest = round_up(most);
  const QRectF all(QPointF(), screen.size);
  std::vector<QList<QLineF>> lines(drawn.size());
  for (const engine::PlaceForces& at : forces) {
    const QPointF position = screen.position_of(at.place_mm);
    if (!all.contains(position) || !screen.shows(at.place_mm, at.outward)) continue;
    const QPointF normal = on_screen(screen, at.place_mm, at.outward);
    const double flat = std::hypot(normal.x(), normal.y());
    if (flat <= 0.0) continue;
    const QPointF across(-normal.y() / flat, normal.x() / flat);
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      const double push = std::clamp(drawn[i].push(at.pushes) / longest, -1.5, 1.5);
      add_arrow(lines[i], position + across * (drawn[i].beside * kBeside), normal * (push * kLongestArrow));
    }
  }
  for (std::size_t i = 0; i < drawn.size(); ++i)
    paint_lines(painter, lines[i], drawn[i].colour, drawn[i].width);
  paint_key(painter, drawn, longest * spacing_mm, screen.size);
}

void paint_explained_place(QPainter& painter, const engine::ExplainedPlace& place,
                           const SurfaceScreen& screen) {
  if (!screen.shows(place.place_mm, place.outward)) return;
  constexpr double kRadius = 6.0;
  const QPointF at = screen.position_of(place.place_mm);
  paint_circle(painter, at, kRadius, false);
  QString text = tr("at rest");
  if (!place.rests()) {
    const QString speed = short_text(std::abs(place.sum_mm()), 2);
    text = place.sum_mm() > 0.0 ? tr("outward, %1 mm").arg(speed) : tr("inward, %1 mm").arg(speed);
  }
  // On the surface's outer side, where it hides neither outline nor ring.
  constexpr double kLength = 200.0;
  const bool at_left = on_screen(screen, place.place_mm, place.outward).x() < 0.0;
  const double left = at_left ? -2.0 * kRadius - kLength : 2.0 * kRadius;
  paint_text(painter, QRectF(at + QPointF(left, -9.0), QSizeF(kLength, 18.0)),
             (at_left ? Qt::AlignRight : Qt::AlignLeft) | Qt::AlignVCenter, text);
}

}  // namespace tidemark::ui
