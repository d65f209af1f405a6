#include "ui/views/overlay.h"

#include <QCoreApplication>
#include <QFontMetricsF>
#include <algorithm>

#include "renderer/annotation.h"
#include "ui/widgets/number_text.h"

namespace tidemark::ui {
namespace {

const QColor kRim(0, 0, 0, 170);
const QColor kVeil(0, 0, 0, 155);  // over white, the text still has a contrast of 4.5
constexpr double kVeilMargin = 4.0;
constexpr double kTextMargin = 8.0;

}  // namespace

void paint_text(QPainter& painter, const QRectF& where, int flags, const QString& text) {
  if (text.isEmpty()) return;
  flags |= Qt::TextDontClip;
  const QColor colour(240, 240, 240);
  painter.setPen(colour);  // without a pen Qt finds that a text takes no room
  const QRectF taken = painter.boundingRect(where, flags, text);
  painter.setPen(Qt::NoPen);
  painter.setBrush(kVeil);
  painter.drawRoundedRect(taken.adjusted(-kVeilMargin, -1.0, kVeilMargin, 1.0), kVeilMargin, kVeilMargin);
  painter.setPen(colour);
  painter.drawText(where, flags, text);
}

void paint_line(QPainter& painter, const QPolygonF& line, const QColor& colour, double width) {
  painter.setBrush(Qt::NoBrush);
  painter.setPen(QPen(kRim, width + 1.5, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
  painter.drawPolyline(line);
  painter.setPen(QPen(colour, width, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
  painter.drawPolyline(line);
}

void paint_fine_lines(QPainter& painter, const QList<QLineF>& lines, const QColor& colour) {
  painter.setPen(QPen(colour, 1.2, Qt::SolidLine, Qt::RoundCap));
  painter.drawLines(lines);
}

void paint_circle(QPainter& painter, QPointF centre, double radius, bool erases) {
  painter.setBrush(Qt::NoBrush);
  painter.setPen(QPen(kRim, 3.0));
  painter.drawEllipse(centre, radius, radius);
  painter.setPen(QPen(erases ? QColor(255, 120, 90) : QColor(255, 255, 255), 1.5,
                      erases ? Qt::DashLine : Qt::SolidLine));
  painter.drawEllipse(centre, radius, radius);
}

void paint_orientation(QPainter& painter, QSizeF size, glm::dvec3 right, glm::dvec3 up, bool is_known) {
  const auto letters = [is_known](glm::dvec3 direction) {
    return is_known ? QString::fromStdString(renderer::orientation_letters(direction)) : QStringLiteral("?");
  };
  const QRectF all(QPointF(kTextMargin, kTextMargin), size - QSizeF(2 * kTextMargin, 2 * kTextMargin));
  paint_text(painter, all, Qt::AlignRight | Qt::AlignVCenter, letters(right));
  paint_text(painter, all, Qt::AlignLeft | Qt::AlignVCenter, letters(-right));
  paint_text(painter, all, Qt::AlignTop | Qt::AlignHCenter, letters(up));
  paint_text(painter, all, Qt::AlignBottom | Qt::AlignHCenter, letters(-up));
}

void paint_scale_bar(QPainter& painter, QSizeF size, double mm_per_pixel) {
  const double length_mm = renderer::scale_bar_mm(0.2 * size.width() * mm_per_pixel);
  if (length_mm <= 0.0) return;
  const double length = length_mm / mm_per_pixel;
  const double y = size.height() - kTextMargin - 3.0;
  const double x = size.width() - kTextMargin - length;
  paint_line(painter, QPolygonF({QPointF(x, y - 4), QPointF(x, y), QPointF(x + length, y),
                                 QPointF(x + length, y - 4)}));
  const QString text = length_mm >= 10.0 ? QCoreApplication::translate("View", "%1 cm").arg(length_mm / 10.0)
                                         : QCoreApplication::translate("View", "%1 mm").arg(length_mm);
  paint_text(painter, QRectF(x, y - 24, length, 18), Qt::AlignHCenter | Qt::AlignBottom, text);
}

void paint_crosshair(QPainter& painter, QSizeF size, QPointF at) {
  constexpr double kGap = 10.0;
  const QColor colour(120, 200, 255, 170);
  painter.setPen(QPen(colour, 1.0));
  painter.drawLine(QPointF(0, at.y()), QPointF(at.x() - kGap, at.y()));
  painter.drawLine(QPointF(at.x() + kGap, at.y()), QPointF(size.width(), at.y()));
  painter.drawLine(QPointF(at.x(), 0), QPointF(at.x(), at.y() - kGap));
  painter.drawLine(QPointF(at.x(), at.y() + kGap), QPointF(at.x(), size.height()));
}

QString text_of(const engine::Measurement& measurement) {
  if (measurement.kind == engine::Measurement::Kind::distance) {
    return QCoreApplication::translate("View", "%1 mm").arg(size_text(measurement.value(), 1));
  }
  return QCoreApplication::translate("View", "%1°").arg(number_text(measurement.value(), 1));
}

bool is_seen_in(const engine::SliceSlab& slice, const engine::Measurement& measurement) {
  return std::ranges::all_of(measurement.points_mm,
                             [&slice](const glm::dvec3& point) { return slice.is_near(point); });
}

void paint_measurement(QPainter& painter, const engine::Measurement& measurement,
                       const std::function<QPointF(glm::dvec3)>& position_of) {
  const QColor colour(140, 230, 160);
  QPolygonF line;
  for (const glm::dvec3& point : measurement.points_mm) line << position_of(point);
  paint_line(painter, line, colour);
  painter.setBrush(colour);
  for (const QPointF& end : line) painter.drawEllipse(end, 2.5, 2.5);
  if (!measurement.complete()) return;
  const QPointF at = measurement.kind == engine::Measurement::Kind::angle ? line[1] : line.last();
  paint_text(painter, QRectF(at + QPointF(8, -18), QSizeF(120, 16)), Qt::AlignLeft | Qt::AlignVCenter,
             text_of(measurement));
}

void paint_measurements(QPainter& painter, const std::vector<engine::Measurement>& measurements,
                        const SliceScreen& screen, const engine::SliceSlab& slice) {
  const auto position_of = [&screen](const glm::dvec3& point) { return screen.position_of(point); };
  for (const engine::Measurement& measurement : measurements) {
    if (is_seen_in(slice, measurement)) paint_measurement(painter, measurement, position_of);
  }
}

void paint_profile(QPainter& painter, const engine::Measurement& line, const SliceScreen& screen,
                   const engine::SliceSlab& slice) {
  if (!is_seen_in(slice, line)) return;
  constexpr double kArrow = 9.0;
  const QColor colour(255, 176, 96);
  const QLineF way(screen.position_of(line.points_mm[0]), screen.position_of(line.points_mm[1]));
  if (way.length() < 1.0) return;
  paint_line(painter, {way.p1(), way.p2()}, colour);
  QLineF side = QLineF(way.p2(), way.p1());
  side.setLength(std::min(kArrow, way.length()));
  const double angle = side.angle();
  QPolygonF head;
  side.setAngle(angle + 25.0);
  head << side.p2() << way.p2();
  side.setAngle(angle - 25.0);
  head << side.p2();
  paint_line(painter, head, colour);
  painter.setPen(QPen(colour, 1.5));
  painter.setBrush(kVeil);
  painter.drawEllipse(way.p1(), 3.5, 3.5);
}

void paint_corner(QPainter& painter, QSizeF size, Qt::Alignment corner, const QStringList& lines) {
  constexpr double kMiddle = 24.0;  // room for the letter of the patient's side
  // At the bottom there is only the scale bar to the right.
  const bool shares = corner.testFlag(Qt::AlignTop);
  const QSizeF room(shares ? (size.width() - kMiddle) / 2.0 - kTextMargin : size.width() - 2.0 * kTextMargin,
                    size.height() - 2.0 * kTextMargin);
  const QFontMetricsF metrics(painter.font());
  QStringList fitting;
  for (const QString& line : lines) fitting << metrics.elidedText(line, Qt::ElideRight, room.width());
  const double x = corner.testFlag(Qt::AlignRight) ? size.width() - kTextMargin - room.width() : kTextMargin;
  paint_text(painter, QRectF(QPointF(x, kTextMargin), room), static_cast<int>(corner | Qt::AlignAbsolute),
             fitting.join('\n'));
}

QStringList patient_lines(const imaging::Patient& patient) {
  QStringList lines;
  const std::string sex_and_age = patient.sex + (patient.sex.empty() ? "" : " ") + patient.age;
  for (const std::string& line : {patient.name, patient.id, sex_and_age}) {
    if (!line.empty()) lines << QString::fromStdString(line);
  }
  return lines;
}

QStringList series_lines(const engine::LoadedStudy& study) {
  QStringList lines;
  if (!study.date.empty()) lines << QString::fromStdString(study.date);
  return lines << study.name;
}

}  // namespace tidemark::ui
