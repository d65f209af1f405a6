// Legends of colours over a picture: what they mean from one end to the other.
#pragma once

#include <QColor>
#include <QList>
#include <QPainter>
#include <QString>

namespace tidemark::ui {

struct ColourScale {
  QList<QColor> colours;  // evenly from low to high
  QString title;
  QString low;
  QString high;
};

// As resources/shaders/render/colours.glsl has them.
ColourScale scale_of_doubt();
ColourScale scale_of_change(double within_mm);
ColourScale scale_of_truth_error(double range_mm);
ColourScale scale_of_spread(double range_mm);
// Of a sweep of that many runs.
ColourScale scale_of_agreement(double runs);

// Above the scale bar at the lower right.
void paint_colour_scale(QPainter& painter, QSizeF size, const ColourScale& scale);

}  // namespace tidemark::ui
