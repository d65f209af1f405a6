// The camera of a 3D view on the surface: brought there when the surface begins, kept there while it grows,
// and near when it has converged.
#pragma once

#include <QObject>
#include <QVariantAnimation>
#include <functional>
#include <memory>
#include <optional>

#include "engine/case_proxy.h"

namespace tidemark::ui {

inline constexpr double kLeastZoom = 0.2;
inline constexpr double kMostZoom = 40.0;

// Moves what the camera looks at and its distance, never the side from which it looks. A camera that somebody
// else has moved is left alone, until fit(). One that was only turned before the first surface is not moved.
class CameraFollower : public QObject {
  Q_OBJECT
 public:
  // `aspect`: of the view's picture; 0 while nobody sees it.
  CameraFollower(engine::CaseProxy& proxy, std::function<double()> aspect, QObject* parent);

  // At once: the surface fills the picture, or the volume where no surface is shown.
  void fit();
  // Looks whether the surface is still in view.
  void follow();

 private:
  [[nodiscard]] const renderer::Camera& camera() const { return proxy_.display().settings().camera; }
  [[nodiscard]] bool is_own() const;
  [[nodiscard]] renderer::Camera on_surface(const renderer::Camera& from, double room) const;
  void catch_up();
  [[nodiscard]] bool sees() const;  // seen_
  void approach();
  void set(const renderer::Camera& camera);
  void glide_to(const renderer::Camera& camera);

  engine::CaseProxy& proxy_;
  std::function<double()> aspect_;
  std::shared_ptr<const solver::Field> seen_;
  std::shared_ptr<const solver::Field> approached_;  // where the camera has gone, or is going
  bool converged_ = false;
  std::optional<renderer::Camera> own_;  // as it was left here
  QVariantAnimation glide_;
  QMetaObject::Connection step_;  // of the glide
};

}  // namespace tidemark::ui
