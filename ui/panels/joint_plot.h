// Two images of a case against each other: their joint histogram, and where the strokes lie in it.
#pragma once

#include "engine/joint_histogram.h"
#include "ui/panels/case_widget.h"

namespace tidemark::ui {

// The study along x, the first further image along y. Where strokes of both kinds mix, the two images do not
// tell them apart.
class JointPlot : public CaseWidget {
  Q_OBJECT
 public:
  explicit JointPlot(QWidget* parent = nullptr);

  // Whether the case has two images to show.
  [[nodiscard]] static bool fits(const document::Drive& drive);
  // Null: not known.
  [[nodiscard]] const std::shared_ptr<const engine::JointHistogram>& histogram() const {
    return counter_->answer();
  }
  // Where a value of both images is drawn.
  [[nodiscard]] QPointF position_of(const engine::JointHistogram::Place& place) const;

  [[nodiscard]] QSize sizeHint() const override { return {240, 210}; }
  [[nodiscard]] QSize minimumSizeHint() const override { return {120, 160}; }

 protected:
  void attach() override;
  void refresh() override;
  void paintEvent(QPaintEvent* event) override;

 private:
  [[nodiscard]] QRectF plot() const;
  void paint_counts(QPainter& painter) const;
  void paint_points(QPainter& painter) const;
  void paint_axes(QPainter& painter) const;

  engine::JointCounter* counter_;
};

}  // namespace tidemark::ui
