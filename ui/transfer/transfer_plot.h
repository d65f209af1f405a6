// A plot of primitives that mouse and keys choose and drag.
#pragma once

#include <QWidget>
#include <optional>

#include "ui/transfer/primitive_handles.h"
#include "ui/widgets/plot_axis.h"

namespace tidemark::ui {

// Has the gestures; derived classes draw primitives and place their handles. A drag changes the primitive
// that was shown last, so that changes from elsewhere during a drag stay.
class TransferPlot : public QWidget {
  Q_OBJECT
 public:
  explicit TransferPlot(QWidget* parent = nullptr);

  void set_axes(const PrimitiveAxis& x, const PrimitiveAxis& y);
  void set_primitives(const std::vector<AxisPrimitive>& primitives, int chosen);
  void reset_zoom();

  [[nodiscard]] const PlotAxis& x_axis() const { return x_axis_; }
  [[nodiscard]] const PlotAxis& y_axis() const { return y_axis_; }
  // Of the chosen primitive.
  [[nodiscard]] std::vector<Handle> handles() const;
  [[nodiscard]] std::optional<HandleKind> selected_handle() const { return selected_; }
  [[nodiscard]] QPointF pixel_of(const Handle& handle) const;
  [[nodiscard]] bool dragging() const { return drag_.has_value(); }
  // The handle's name and the number that it stands for: "Centre 230 HU".
  [[nodiscard]] QString handle_text(const HandleKind& handle) const;

  [[nodiscard]] QSize sizeHint() const override { return {360, 230}; }
  [[nodiscard]] QSize minimumSizeHint() const override { return {220, 170}; }

 signals:
  void chosen(int index);
  void edited(int index, const tidemark::ui::AxisPrimitive& primitive);
  void delete_asked();

 protected:
  [[nodiscard]] virtual std::vector<Handle> handles_of(const AxisPrimitive& primitive) const = 0;
  // The distance of the pointer from the painted primitive; unset when it is too far for a choice.
  [[nodiscard]] virtual std::optional<double> distance(const AxisPrimitive& primitive,
                                                       QPointF pointer) const = 0;
  // Whether there is an axis at the right.
  [[nodiscard]] virtual bool shows_counts() const { return false; }
  // The extent of the second axis, given all primitives.
  [[nodiscard]] virtual PlotAxis fitted_y() const = 0;
  virtual void paint_background(QPainter& painter) = 0;
  virtual void paint_primitive(QPainter& painter, const AxisPrimitive& primitive, int number,
                               bool chosen) = 0;
  virtual void paint_axes(QPainter& painter) = 0;

  [[nodiscard]] QRectF area() const;  // without the axes
  [[nodiscard]] Extent shown_x() const { return {x_axis_.low, x_axis_.high}; }
  [[nodiscard]] Extent shown_y() const { return {y_axis_.low, y_axis_.high}; }
  [[nodiscard]] const std::vector<AxisPrimitive>& primitives() const { return primitives_; }
  [[nodiscard]] QString title_of(const PrimitiveAxis& axis) const;

  PrimitiveAxis x_;
  PrimitiveAxis y_;

  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void leaveEvent(QEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void focusInEvent(QFocusEvent* event) override;
  bool focusNextPrevChild(bool next) override;

 private:
  struct Drag {
    int index = 0;
    HandleKind handle;
    QPointF offset;   // from the handle to the pointer
    QPointF pressed;  // where
    bool begun = false;
    AxisPrimitive before;
  };
  struct Pan {
    double from = 0.0;  // pixel
    Extent shown;
  };

  void fit();
  void paint_handles(QPainter& painter);
  [[nodiscard]] Extent whole_x() const;
  [[nodiscard]] bool has(int index) const;
  [[nodiscard]] std::optional<Handle> handle_at(QPointF pointer) const;
  [[nodiscard]] std::optional<int> primitive_at(QPointF pointer) const;
  void drag_to(QPointF pointer);
  void move_by_keys(QPointF direction, bool coarse);
  void zoom(double factor, double about);
  void show_cursor(QPointF pointer);

  PlotAxis x_axis_;
  PlotAxis y_axis_;
  std::vector<AxisPrimitive> primitives_;
  int chosen_ = 0;
  std::optional<HandleKind> selected_;  // of the chosen primitive; keys move it
  std::optional<HandleKind> hovered_;
  std::optional<Drag> drag_;
  std::optional<Pan> pan_;
  std::optional<Extent> zoomed_;  // of the first axis
};

}  // namespace tidemark::ui
