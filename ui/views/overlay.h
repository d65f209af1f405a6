// The overlay of pictures: lines and text that are seen on bright and on dark ones.
#pragma once

#include <QLineF>
#include <QList>
#include <QPainter>
#include <QPolygonF>
#include <QString>
#include <QStringList>
#include <functional>

#include "core/geometry.h"
#include "engine/measurement.h"
#include "engine/slice_slab.h"
#include "engine/study_loader.h"
#include "renderer/camera.h"
#include "ui/views/view_geometry.h"

namespace tidemark::ui {

// Light on a dark veil, so that it is read on bright tissue, too.
// `flags`: Qt::AlignmentFlag and Qt::TextFlag.
void paint_text(QPainter& painter, const QRectF& where, int flags, const QString& text);
void paint_line(QPainter& painter, const QPolygonF& line, const QColor& colour = Qt::white,
                double width = 1.5);
// So fine that the surface's outline is still seen where both are the same.
void paint_fine_lines(QPainter& painter, const QList<QLineF>& lines, const QColor& colour);
// Of a known answer: apart from the surface's yellow, the speed map's colours and the first labels', also
// for colour-blind eyes.
inline constexpr QColor kTruthColour(190, 40, 255);
// Of a state of the history that is compared: apart from these, too.
inline constexpr QColor kComparedColour(0, 222, 190);
// Of what a tool would make of labels, and of a stroke over one.
inline constexpr QColor kPreviewColour(255, 60, 140);
// A sphere's outline; one that takes away is dashed.
void paint_circle(QPainter& painter, QPointF centre, double radius, bool erases);

// The letters of the patient's sides in the middle of the four edges; "?" where they are not known.
void paint_orientation(QPainter& painter, QSizeF size, glm::dvec3 right, glm::dvec3 up, bool is_known);
// A bar whose length is a round number of millimetres.
void paint_scale_bar(QPainter& painter, QSizeF size, double mm_per_pixel);
// With a gap in the middle.
void paint_crosshair(QPainter& painter, QSizeF size, QPointF at);
// Whether all its points are in the slice.
[[nodiscard]] bool is_seen_in(const engine::SliceSlab& slice, const engine::Measurement& measurement);
// `position_of`: of a point of the patient.
void paint_measurement(QPainter& painter, const engine::Measurement& measurement,
                       const std::function<QPointF(glm::dvec3)>& position_of);
// Those that are seen in the slice.
void paint_measurements(QPainter& painter, const std::vector<engine::Measurement>& measurements,
                        const SliceScreen& screen, const engine::SliceSlab& slice);
QString text_of(const engine::Measurement& measurement);
// The line along which values are plotted, with a ring at its beginning and an arrow at its end; likewise.
void paint_profile(QPainter& painter, const engine::Measurement& line, const SliceScreen& screen,
                   const engine::SliceSlab& slice);

// Lines in a corner, those at the top cut short where they would meet the ones of the other corner.
void paint_corner(QPainter& painter, QSizeF size, Qt::Alignment corner, const QStringList& lines);
// Texts of the corners at the top: patient and study, and series.
QStringList patient_lines(const imaging::Patient& patient);
QStringList series_lines(const engine::LoadedStudy& study);

}  // namespace tidemark::ui
