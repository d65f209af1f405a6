// A small curve over the steps, with its last value in print.
#pragma once

#include <QPointF>
#include <QWidget>
#include <optional>
#include <vector>

namespace tidemark::ui {

class CurvePlot : public QWidget {
  Q_OBJECT
 public:
  // On a logarithmic scale values <= 0 are left out.
  CurvePlot(const QString& title, const QString& unit, bool logarithmic, QWidget* parent = nullptr);

  // A dashed line with a meaning.
  void set_mark(double value, const QString& meaning);
  void set_points(std::vector<QPointF> points);  // (step, value), in order
  [[nodiscard]] const std::vector<QPointF>& points() const { return points_; }
  [[nodiscard]] QString last_text() const;

  [[nodiscard]] QSize sizeHint() const override;
  [[nodiscard]] QSize minimumSizeHint() const override;

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  struct Span {
    double low = 0.0;
    double high = 1.0;
  };
  [[nodiscard]] double scaled(double value) const;
  [[nodiscard]] Span span() const;  // of scaled values
  void paint_curve(QPainter& painter, const QRectF& area) const;

  QString title_;
  QString unit_;
  bool logarithmic_;
  std::optional<double> mark_;
  std::vector<QPointF> points_;
};

}  // namespace tidemark::ui
