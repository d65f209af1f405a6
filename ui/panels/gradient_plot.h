// The histogram of |grad phi|, near the surface and in the whole band, with the target of rescaling.
#pragma once

#include <QWidget>
#include <optional>

#include "solver/gradient_histogram.h"

namespace tidemark::ui {

class GradientPlot : public QWidget {
  Q_OBJECT
 public:
  // The axis reaches so many targets: at a sharp border the data term steepens phi well above its target.
  static constexpr double kTargets = 4.0;

  explicit GradientPlot(QWidget* parent = nullptr);

  // Unset: nothing is known.
  void set_histogram(const std::optional<solver::GradientHistogram>& histogram);
  [[nodiscard]] const std::optional<solver::GradientHistogram>& histogram() const { return histogram_; }
  void set_target(double gradient);
  [[nodiscard]] double target() const { return target_; }

  [[nodiscard]] QSize sizeHint() const override { return {240, 112}; }
  [[nodiscard]] QSize minimumSizeHint() const override { return {120, 112}; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  void paint_bars(QPainter& painter, const QRectF& area) const;
  void paint_axis(QPainter& painter, const QRectF& area) const;
  void paint_legend(QPainter& painter) const;

  std::optional<solver::GradientHistogram> histogram_;
  double target_ = 1.0;
};

}  // namespace tidemark::ui
