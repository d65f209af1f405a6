// The runs of a sweep as a matrix of pictures, with a number on a colour below each.
#pragma once

#include <QPoint>
#include <QWidget>
#include <memory>
#include <optional>

#include "document/sweep_picture.h"
#include "engine/case_sweep.h"

namespace tidemark::ui {

class SweepMatrix : public QWidget {
  Q_OBJECT
 public:
  enum class Colours { volume, dice };

  explicit SweepMatrix(QWidget* parent = nullptr);

  void show_outcome(std::shared_ptr<const engine::SweepOutcome> outcome);  // null: nothing
  void set_colours(Colours colours);
  // The run that the case is now; unset: none of them.
  void set_taken(std::optional<QPoint> cell);

  // The cell under the mouse, else the one that keys have chosen: column and row.
  [[nodiscard]] QPoint current() const { return hovered_.value_or(chosen_); }
  [[nodiscard]] QRect picture_at(QPoint cell) const;  // where its picture is

 signals:
  void looked_at(QPoint cell);
  void wanted(QPoint cell);  // to be taken: a click, or Enter

 protected:
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void leaveEvent(QEvent* event) override;

 private:
  void lay_out();
  [[nodiscard]] std::optional<QPoint> cell_at(QPoint place) const;
  [[nodiscard]] const document::SweepRun& run_at(QPoint cell) const;
  void paint_axes(QPainter& painter) const;
  void paint_run(QPainter& painter, QPoint cell) const;
  void paint_scale(QPainter& painter) const;

  std::shared_ptr<const engine::SweepOutcome> outcome_;
  Colours colours_ = Colours::volume;
  document::SweepScale scale_;
  std::optional<QPoint> taken_, hovered_;
  QPoint chosen_{0, 0};
  // In logical pixels.
  int side_ = 1;   // of a picture
  int strip_ = 1;  // of a number's height
  int left_ = 0;   // for the values of the rows
  int top_ = 0;    // for those of the columns
};

// One run in words: "α 0.48, ε 66: 112.6 ml, Dice 0.980, 512 steps, at rest".
[[nodiscard]] QString sweep_run_text(const document::Sweep& sweep, QPoint cell);

}  // namespace tidemark::ui
