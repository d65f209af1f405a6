// The common look of plots of transfer functions. Colours come from the palette.
#pragma once

#include <QPainter>
#include <QPalette>
#include <QString>

#include "ui/look/colour.h"
#include "ui/widgets/plot_axis.h"

namespace tidemark::ui {

// The room that axes take around the plot's area, in logical pixels.
struct PlotMargins {
  int left = 0;
  int right = 0;
  int top = 0;
  int bottom = 0;
};
PlotMargins plot_margins(const QFontMetrics& metrics, bool with_counts);

// Labels of axes are a little smaller than other text.
QFont axis_font(const QFont& font);

// Ticks, their numbers and the title, below the area or at its left. A greyed axis has the colour of
// disabled text.
void draw_bottom_axis(QPainter& painter, const QRectF& area, const PlotAxis& axis, const QString& title,
                      const QColor& colour);
void draw_left_axis(QPainter& painter, const QRectF& area, const PlotAxis& axis, const QString& title,
                    const QColor& colour);
// Powers of ten up to `most` at the right of the area, whose height is log(1 + count).
void draw_count_axis(QPainter& painter, const QRectF& area, double most, const QString& title,
                     const QColor& colour);

enum class HandleShape { round, square };
enum class HandleState { plain, hovered, selected };
void draw_handle(QPainter& painter, QPointF at, HandleShape shape, HandleState state,
                 const QPalette& palette);
// A primitive's number in the list, so that it is not known by its colour alone.
void draw_number(QPainter& painter, QPointF at, int number, bool chosen, const QPalette& palette);
// The value that is being set, in a corner of the area.
void draw_read_out(QPainter& painter, const QRectF& area, const QString& text, const QPalette& palette);

}  // namespace tidemark::ui
