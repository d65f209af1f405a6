#include "ui/views/force_arrows.h"

#include <QCoreApplication>
#include <QFontMetricsF>
#include <algorithm>
#include <cmath>

#include "ui/look/term_colours.h"
#include "ui/views/overlay.h"
#include "ui/widgets/number_text.h"

namespace tidemark::ui {
namespace {

constexpr double kLongest = 34.0;  // logical pixels
constexpr double kShortest = 1.5;  // below it an arrow is not drawn
constexpr double kBeside = 3.5;    // between arrows of one place
constexpr double kHead = 4.5;
const QColor kSumColour(250, 250, 250);

QString tr(const char* text) {
  return QCoreApplication::translate("ForceArrows", text);
}

struct Kind {
  QString name;
  QColor colour;
  double (*push)(const solver::Pushes&);
  double beside;  // of the normal, in steps of kBeside
  double width;
};

std::vector<Kind> kinds(const std::vector<engine::PlaceForces>& forces) {
  std::vector<Kind> kinds{
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
double largest_push(const std::vector<engine::PlaceForces>& forces, const std::vector<Kind>& kinds) {
  std::vector<double> pushes;
  for (const engine::PlaceForces& at : forces) {
    for (const Kind& kind : kinds) pushes.push_back(std::abs(kind.push(at.pushes)));
  }
  if (pushes.empty()) return 0.0;
  const auto nearly_last = pushes.begin() + static_cast<std::ptrdiff_t>(pushes.size() * 19 / 20);
  std::nth_element(pushes.begin(), nearly_last, pushes.end());
  return *nearly_last;
}

void paint_arrow(QPainter& painter, QPointF from, QPointF way, const QColor& colour, double width) {
  const double length = std::hypot(way.x(), way.y());
  if (length < kShortest) return;
  const QPointF along = way / length;
  const QPointF across(-along.y(), along.x());
  const QPointF tip = from + way;
  const double head = std::min(kHead, 0.6 * length);
  const QPolygonF wings{tip - along * head + across * (0.6 * head), tip,
                        tip - along * head - across * (0.6 * head)};
  paint_line(painter, {from, tip}, colour, width);
  paint_line(painter, wings, colour, width);
}

// The outward normal as the view shows it: of length 1 where it lies in the picture.
QPointF on_screen(const SurfaceScreen& screen, glm::dvec3 place_mm, glm::dvec3 outward) {
  return (screen.position_of(place_mm + outward) - screen.position_of(place_mm)) * screen.mm_per_pixel;
}

void paint_key(QPainter& painter, const std::vector<Kind>& kinds, double largest_mm, QSizeF size) {
  constexpr double kMargin = 8.0;
  constexpr double kLetter = 24.0;  // of the patient's side, below it
  constexpr double kDash = 14.0;
  const QFontMetricsF metrics(painter.font());
  const QString length = tr("longest: %1 mm per unit of time").arg(short_text(largest_mm, 2));
  double width = metrics.horizontalAdvance(length);
  for (const Kind& kind : kinds) width += kDash + 16.0 + metrics.horizontalAdvance(kind.name);
  double x = std::max(kMargin, 0.5 * (size.width() - width));
  const double y = size.height() - kMargin - kLetter - 2.0 * metrics.height();
  for (const Kind& kind : kinds) {
    const double text = metrics.horizontalAdvance(kind.name);
    paint_line(painter,
               {QPointF(x, y + 0.5 * metrics.height()), QPointF(x + kDash, y + 0.5 * metrics.height())},
               kind.colour, kind.width);
    paint_text(painter, QRectF(x + kDash + 6.0, y, text, metrics.height()), Qt::AlignLeft | Qt::AlignVCenter,
               kind.name);
    x += kDash + text + 16.0;
  }
  paint_text(painter, QRectF(x, y, metrics.horizontalAdvance(length), metrics.height()),
             Qt::AlignLeft | Qt::AlignVCenter, length);
}

}  // namespace

void paint_forces(QPainter& painter, const std::vector<engine::PlaceForces>& forces, double spacing_mm,
                  const SurfaceScreen& screen) {
  const std::vector<Kind> drawn = kinds(forces);
  const double most = largest_push(forces, drawn);
  if (most <= 0.0) return;
  const double longest = round_up(most);
  const QRectF all(QPointF(), screen.size);
  for (const engine::PlaceForces& at : forces) {
    const QPointF position = screen.position_of(at.place_mm);
    if (!all.contains(position) || !screen.shows(at.place_mm, at.outward)) continue;
    const QPointF normal = on_screen(screen, at.place_mm, at.outward);
    const double flat = std::hypot(normal.x(), normal.y());
    if (flat <= 0.0) continue;
    const QPointF across(-normal.y() / flat, normal.x() / flat);
    for (const Kind& kind : drawn) {
      const double push = std::clamp(kind.push(at.pushes) / longest, -1.5, 1.5);
      paint_arrow(painter, position + across * (kind.beside * kBeside), normal * (push * kLongest),
                  kind.colour, kind.width);
    }
  }
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
  paint_text(painter, QRectF(at + QPointF(2.0 * kRadius, -9.0), QSizeF(160.0, 18.0)),
             Qt::AlignLeft | Qt::AlignVCenter, text);
}

}  // namespace tidemark::ui
