// phi and brightness along a line, one above the other.
#pragma once

#include <QWidget>

#include "solver/line_profile.h"
#include "ui/widgets/plot_axis.h"

namespace tidemark::ui {

class ProfilePlot : public QWidget {
  Q_OBJECT
 public:
  explicit ProfilePlot(QWidget* parent = nullptr);

  struct Content {
    solver::LineProfile profile;
    double length_mm = 0.0;   // of the line
    double band = 2.5;        // W, smallest spacings
    double spacing_mm = 1.0;  // the smallest
    double target = 0.0;      // T
    double range = 0.0;       // epsilon; 0: T and epsilon do not count
    QString unit;             // of brightness
  };
  void set_content(Content content);
  [[nodiscard]] const Content& content() const { return content_; }

  [[nodiscard]] QSize sizeHint() const override;
  [[nodiscard]] QSize minimumSizeHint() const override { return {160, sizeHint().height()}; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  struct Pane {
    QRectF area;
    PlotAxis along;
    PlotAxis up;
  };
  [[nodiscard]] QRectF pane_area(double top, double high) const;
  [[nodiscard]] Pane phi_pane() const;
  [[nodiscard]] Pane value_pane() const;
  void paint_pane(QPainter& painter, const Pane& pane, const QString& left, const QString& right) const;
  void paint_inside(QPainter& painter, const Pane& pane) const;
  void paint_curve(QPainter& painter, const Pane& pane, double solver::ProfilePoint::*quantity) const;
  void paint_ticks(QPainter& painter, const Pane& pane, double mm_per_unit) const;
  void paint_along(QPainter& painter, const Pane& pane) const;

  Content content_;
};

}  // namespace tidemark::ui
