// A view of a case: a picture from the engine, what is drawn over it, and the mouse.
#pragma once

#include <QWidget>
#include <functional>
#include <memory>
#include <optional>

#include "engine/force_sampler.h"
#include "engine/picture_feed.h"
#include "ui/views/colour_scale.h"
#include "ui/views/gesture.h"

namespace tidemark::ui {

class PictureSurface;

class PictureView : public QWidget {
  Q_OBJECT
 public:
  explicit PictureView(engine::CaseProxy& proxy, QWidget* parent = nullptr);
  ~PictureView() override;

  [[nodiscard]] engine::CaseProxy& proxy() const { return proxy_; }
  [[nodiscard]] const engine::PictureFeed& feed() const { return feed_; }
  // Another case's window lies over it.
  void set_covered(bool covered);
  [[nodiscard]] virtual QString title() const = 0;
  [[nodiscard]] renderer::PictureSize physical_size() const;
  // The picture with its overlay, in physical pixels.
  [[nodiscard]] QImage grab_picture();
  // The widget for pictures that are textures; null where they are images (Engine::pictures()).
  [[nodiscard]] const PictureSurface* surface() const { return surface_; }

  // Of a point of the patient (LPS, mm), in logical pixels.
  [[nodiscard]] virtual QPointF position_of(glm::dvec3 patient_mm) const = 0;
  // On the slice or the clip plane; none beside it.
  [[nodiscard]] virtual std::optional<glm::dvec3> patient_at(QPointF position) const = 0;
  [[nodiscard]] virtual double mm_per_pixel() const = 0;
  // Whether a place on the surface is seen; `outward` is the surface's normal there.
  [[nodiscard]] virtual bool shows(glm::dvec3 place_mm, glm::dvec3 outward) const = 0;
  // The voxels that a slice shows; none in 3D.
  [[nodiscard]] virtual std::optional<engine::SliceSlab> slab() const { return std::nullopt; }

  // The cross-section of the brush, or of the sphere that is being drawn in any view, in logical pixels.
  struct Ring {
    QPointF centre;
    double radius = 0.0;
    bool erases = false;
  };
  [[nodiscard]] std::optional<Ring> ring() const;

  [[nodiscard]] QSize sizeHint() const override { return {420, 380}; }
  [[nodiscard]] QSize minimumSizeHint() const override { return {120, 100}; }

  // As it is drawn, but for what is painted over it.
  [[nodiscard]] virtual engine::AnyView wanted() const = 0;
  // Shown in place of the case's labels; null: those.
  [[nodiscard]] virtual std::shared_ptr<const document::Labels> wanted_labels() const { return nullptr; }

 signals:
  void maximise_wanted();
  void activated();  // clicked, or given the keyboard
  // A click with the right button, or the key for menus: where, and what of the patient lies there.
  void menu_wanted(QPoint position, std::optional<glm::dvec3> place_mm);

 protected:
  [[nodiscard]] engine::Display& display() const { return proxy_.display(); }
  [[nodiscard]] const engine::DisplaySettings& settings() const { return proxy_.display().settings(); }
  // Whether colours may say how far the surface is from the truth, or from where it began, or how far apart
  // the runs of a sweep end there (in 3D alone). While the map of one is made, none of them does.
  [[nodiscard]] bool shows_distances() const;
  // Of these colours; none: there are none.
  [[nodiscard]] std::optional<ColourScale> scale_of_distances() const;
  [[nodiscard]] DragView drag_view();

  // Asks the engine for the view that is wanted now.
  void ask();
  // To be called instead of update().
  void paint_again();
  virtual void paint_overlay(QPainter& painter) = 0;
  // The corners at the top: patient and study, series, and a note of the view. A low view has room for the
  // name and the note only.
  void paint_study(QPainter& painter, const QString& note = {}) const;
  // A sentence in the lower middle: why something is not shown.
  void paint_reason(QPainter& painter, const QString& reason) const;
  // Drags that are about the view itself; `first_choice`: the left button of a tool that has nothing to do
  // here.
  virtual std::unique_ptr<Drag> navigation_drag(const Pointer& pressed) = 0;
  // The part of the patient whose surface has arrows here; none: all of it.
  [[nodiscard]] virtual std::optional<solver::PlaneSlab> force_slab() const { return std::nullopt; }
  virtual void scroll(int clicks) = 0;
  virtual void zoom(double factor, QPointF about) = 0;
  // What of the patient is seen at a position; the answer may come later.
  virtual void find_place(QPointF position, std::function<void(std::optional<glm::dvec3>)> answer);
  // The mouse's shape there, while no button is down.
  [[nodiscard]] virtual Qt::CursorShape cursor_at(QPointF position) const;
  // What the left or right button starts with the tool that is chosen.
  virtual std::unique_ptr<Drag> begin_drag(const Pointer& pressed);
  // In place of what the button that is down has begun.
  void replace_drag(std::unique_ptr<Drag> drag);
  [[nodiscard]] bool pressed() const { return gesture_.is_held(); }
  // The button that was down is up.
  virtual void button_lifted() {}

  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void showEvent(QShowEvent* event) override;
  void hideEvent(QHideEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void contextMenuEvent(QContextMenuEvent* event) override;
  void leaveEvent(QEvent* event) override;
  void focusInEvent(QFocusEvent* event) override;
  bool event(QEvent* event) override;

 private:
  [[nodiscard]] bool is_seen() const { return isVisible() && !covered_; }
  void follow_display();
  void follow_state();
  void follow_forces();
  void explain_at(QPointF position);
  void paint_balance(QPainter& painter) const;
  void lift(bool counts);  // see Gesture
  void ask_for_menu(QPointF position);
  void ask_for_menu_by_key();
  void paint_all(QPainter& painter);
  void paint_picture(QPainter& painter);
  [[nodiscard]] Gesture::Ground ground() const;
  [[nodiscard]] Pointer pointer_at(const QMouseEvent& event) const;

  engine::CaseProxy& proxy_;
  engine::PictureFeed feed_;
  PictureSurface* surface_ = nullptr;  // covers the whole view
  bool covered_ = false;
  Gesture gesture_;
  QPointF mouse_;
  QPointF pressed_at_;
  bool may_be_click_ = false;  // the right button is down, and the mouse has not moved yet
  // Of the last state.
  engine::SurfaceMap surface_map_ = engine::SurfaceMap::none;
  bool lacks_speed_ = false;
  engine::ForceSampler forces_;
  bool explaining_ = false;      // a place is being looked for
  bool brings_forward_ = false;  // the press that follows makes the case active
  bool only_activates_ = false;  // the last press did, and changes nothing
  int wheel_remainder_ = 0;      // of mice that turn by less than a click
};

}  // namespace tidemark::ui
