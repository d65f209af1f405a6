// The speed D(I) of the paper's eq. 7 (its Fig. 11) over the histogram of the source, for dragging.
#pragma once

#include <QWidget>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/source_summary.h"
#include "ui/widgets/plot_axis.h"

namespace tidemark::ui {

// The peak of the tent is T; its feet, where D = 0, are T - epsilon and T + epsilon. Inside the feet the
// surface grows, outside it shrinks. Left and right move T, up and down change epsilon.
class SpeedPlot : public QWidget {
  Q_OBJECT
 public:
  explicit SpeedPlot(QWidget* parent = nullptr);

  void set_source(const engine::SourceSummary& summary, const QString& unit);
  void set_tent(double target, double range);
  // A value that is to be seen on the tent; none: no mark.
  void set_mark(std::optional<double> value);
  [[nodiscard]] const std::optional<double>& mark() const { return mark_; }
  [[nodiscard]] double target() const { return target_; }
  [[nodiscard]] double range() const { return range_; }

  // Where the handles are, in the widget's coordinates.
  [[nodiscard]] QPointF peak() const;
  [[nodiscard]] QPointF left_foot() const;
  [[nodiscard]] QPointF right_foot() const;

  [[nodiscard]] QSize sizeHint() const override { return {240, 116}; }
  [[nodiscard]] QSize minimumSizeHint() const override { return {120, 96}; }

 signals:
  // One drag, or one press of a key, is one gesture.
  void edited(double target, double range, std::uint64_t gesture);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void leaveEvent(QEvent* event) override;

 private:
  enum class Handle { none, peak, left_foot, right_foot };
  [[nodiscard]] QRectF plot() const;
  [[nodiscard]] PlotAxis values() const;
  [[nodiscard]] double height_of(double speed) const;  // the pixel of D
  [[nodiscard]] Handle handle_at(QPointF place) const;
  void show_span();
  void drag_to(double value);
  void change(double target, double range);
  void paint_histogram(QPainter& painter) const;
  void paint_tent(QPainter& painter) const;
  void paint_mark(QPainter& painter) const;
  void paint_handles(QPainter& painter) const;
  void paint_values(QPainter& painter) const;

  std::vector<double> bars_;  // of [low_, high_], 0 to 1
  double low_ = 0.0;
  double high_ = 1.0;
  double lowest_ = 0.0;
  double highest_ = 1.0;
  QString unit_;
  int decimals_ = 0;
  double shown_low_ = 0.0;
  double shown_high_ = 1.0;

  double target_ = 0.5;
  double range_ = 0.1;
  std::optional<double> mark_;
  Handle hovered_ = Handle::none;
  Handle dragged_ = Handle::none;
  double grip_ = 0.0;  // from the pointer to the handle, in values
  std::uint64_t gesture_ = 0;
};

}  // namespace tidemark::ui
