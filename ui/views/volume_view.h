// The view in 3D.
#pragma once

#include "ui/views/camera_follower.h"
#include "ui/views/clip_handles.h"
#include "ui/views/picture_view.h"

namespace tidemark::ui {

class VolumeViewWidget : public PictureView {
  Q_OBJECT
 public:
  explicit VolumeViewWidget(engine::CaseProxy& proxy, QWidget* parent = nullptr);

  [[nodiscard]] QString title() const override { return tr("3D"); }
  [[nodiscard]] QPointF position_of(glm::dvec3 patient_mm) const override {
    return screen().position_of(patient_mm);
  }
  [[nodiscard]] std::optional<glm::dvec3> patient_at(QPointF position) const override;
  [[nodiscard]] double mm_per_pixel() const override { return screen().mm_per_pixel(); }
  [[nodiscard]] bool shows(glm::dvec3 place_mm, glm::dvec3 outward) const override;
  [[nodiscard]] ClipHandles handles() const;
  [[nodiscard]] renderer::VolumeView view() const;
  // The surface, or the volume without one, fills the view.
  void fit_camera() { follower_.fit(); }

 signals:
  void place_wanted();  // the tool and the panel that place a surface

 protected:
  [[nodiscard]] engine::AnyView wanted() const override { return view(); }
  // With what a tool is about to make of them.
  [[nodiscard]] std::shared_ptr<const document::Labels> wanted_labels() const override;
  void paint_overlay(QPainter& painter) override;
  void find_place(QPointF position, std::function<void(std::optional<glm::dvec3>)> answer) override;
  std::unique_ptr<Drag> begin_drag(const Pointer& pressed) override;
  std::unique_ptr<Drag> navigation_drag(const Pointer& pressed) override;
  void scroll(int clicks) override;
  void zoom(double factor, QPointF about) override;
  void showEvent(QShowEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void button_lifted() override;

 private:
  [[nodiscard]] VolumeScreen screen() const;
  [[nodiscard]] bool shows_no_speed() const;  // where its colours are wanted, for want of a function
  void pick_and_begin(const Pointer& pressed);
  // The place on the surface under a position; none where there is no surface.
  void pick(QPointF position, std::function<void(std::optional<glm::dvec3>)> answer);

  CameraFollower follower_;
  // A drag that began on the surface goes on in the plane through that point that faces the viewer.
  std::optional<glm::dvec3> grip_mm_;
  std::uint64_t press_number_ = 0;
};

}  // namespace tidemark::ui
