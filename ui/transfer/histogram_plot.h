// A histogram of values, and over it how opaque each primitive makes them.
#pragma once

#include <cstdint>

#include "ui/transfer/transfer_plot.h"

namespace tidemark::ui {

// Counts are drawn by their logarithm; opacity by its third root, as a thousandth of a mm is much in a volume
// and a half is, too.
class HistogramPlot : public TransferPlot {
  Q_OBJECT
 public:
  explicit HistogramPlot(QWidget* parent = nullptr);

  // Of evenly long parts of [low, high].
  void set_counts(const std::vector<std::int64_t>& counts, const Extent& range);

 protected:
  [[nodiscard]] std::vector<Handle> handles_of(const AxisPrimitive& primitive) const override;
  [[nodiscard]] std::optional<double> distance(const AxisPrimitive& primitive,
                                               QPointF pointer) const override;
  [[nodiscard]] bool shows_counts() const override { return true; }
  [[nodiscard]] PlotAxis fitted_y() const override;
  void paint_background(QPainter& painter) override;
  void paint_primitive(QPainter& painter, const AxisPrimitive& primitive, int number, bool chosen) override;
  void paint_axes(QPainter& painter) override;

 private:
  std::vector<std::int64_t> counts_;
  Extent range_;
  double most_ = 1.0;  // of the counts
};

}  // namespace tidemark::ui
