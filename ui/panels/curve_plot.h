// A small curve over the steps, with its last value in print, and perhaps a predicted one.
#pragma once

#include <QPen>
#include <QPointF>
#include <QWidget>
#include <optional>
#include <vector>

namespace tidemark::ui {

class CurvePlot : public QWidget {
  Q_OBJECT
 public:
  // On a logarithmic scale values <= 0 are not drawn.
  CurvePlot(const QString& title, const QString& unit, bool logarithmic, QWidget* parent = nullptr);

  // A dashed line with a meaning.
  void set_mark(double value, const QString& meaning);
  void set_points(std::vector<QPointF> points);  // (step, value), in order
  [[nodiscard]] const std::vector<QPointF>& points() const { return points_; }
  // A dashed curve over it; empty: none.
  void set_predicted(std::vector<QPointF> points);
  [[nodiscard]] const std::vector<QPointF>& predicted() const { return predicted_; }
  // From the left end to the right one, which lies beyond it.
  struct Steps {
    double first = 0.0;
    double last = 1.0;

    bool operator==(const Steps&) const = default;
  };
  void set_steps(Steps steps);
  [[nodiscard]] const Steps& steps() const { return steps_; }
  [[nodiscard]] QString last_text() const;

  static QPen measured_pen(const QPalette& palette);
  static QPen predicted_pen(const QPalette& palette);

  [[nodiscard]] QSize sizeHint() const override;
  [[nodiscard]] QSize minimumSizeHint() const override;

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  struct Span {
    double low = 0.0;
    double high = 1.0;
  };
  [[nodiscard]] bool has_place(double value) const { return !logarithmic_ || value > 0.0; }
  [[nodiscard]] double scaled(double value) const;
  [[nodiscard]] Span span() const;  // of scaled values that have a place
  void paint_curve(QPainter& painter, const QRectF& area) const;

  QString title_;
  QString unit_;
  bool logarithmic_;
  std::optional<double> mark_;
  std::vector<QPointF> points_;
  std::vector<QPointF> predicted_;
  Steps steps_;
};

}  // namespace tidemark::ui
