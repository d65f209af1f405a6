// Two axes of a transfer function: what each primitive covers, over how often the two occur together.
#pragma once

#include <QImage>
#include <cstdint>

#include "ui/transfer/transfer_plot.h"

namespace tidemark::ui {

class JointHistogramPlot : public TransferPlot {
  Q_OBJECT
 public:
  explicit JointHistogramPlot(const QString& accessible_name, QWidget* parent = nullptr);

  // Counts of columns x rows evenly large parts of both extents, columns fastest; drawn by their logarithm.
  void set_counts(const std::vector<std::int64_t>& counts, int columns, const Extent& x, const Extent& y);

 protected:
  [[nodiscard]] std::vector<Handle> handles_of(const AxisPrimitive& primitive) const override;
  [[nodiscard]] std::optional<double> distance(const AxisPrimitive& primitive,
                                               QPointF pointer) const override;
  [[nodiscard]] PlotAxis fitted_y() const override;
  void paint_background(QPainter& painter) override;
  void paint_primitive(QPainter& painter, const AxisPrimitive& primitive, int number, bool chosen) override;
  void paint_axes(QPainter& painter) override;

 private:
  [[nodiscard]] QRectF reach_in_pixels(const AxisPrimitive& primitive) const;

  QImage counts_;  // of alpha alone, its first row at the top
  Extent counts_x_;
  Extent counts_y_;
};

}  // namespace tidemark::ui
