#include "ui/views/camera_follower.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "renderer/sheet.h"

namespace tidemark::ui {
namespace {

constexpr int kGlide = 350;  // ms
// Around a surface that may grow: it fills the rest of the picture before the camera moves again.
constexpr double kSurfaceRoom = 1.3;
// A seed stays in the context of its volume.
constexpr double kNearest = 4.0;

renderer::Camera between(const renderer::Camera& from, const renderer::Camera& to, double share,
                         glm::dvec3 middle) {
  renderer::Camera camera = to;
  camera.zoom = from.zoom * std::pow(to.zoom / from.zoom, share);
  camera.focus_mm = glm::mix(from.focus_mm.value_or(middle), to.focus_mm.value_or(middle), share);
  return camera;
}

}  // namespace

CameraFollower::CameraFollower(engine::CaseProxy& proxy, std::function<double()> aspect, QObject* parent)
    : QObject(parent), proxy_(proxy), aspect_(std::move(aspect)) {
  glide_.setDuration(kGlide);
  glide_.setEasingCurve(QEasingCurve::InOutQuad);
  glide_.setStartValue(0.0);
  glide_.setEndValue(1.0);
  connect(&proxy, &engine::CaseProxy::state_changed, this, &CameraFollower::follow);
  connect(&glide_, &QVariantAnimation::finished, this, &CameraFollower::catch_up);
}

void CameraFollower::fit() {
  if (aspect_() <= 0.0) return;
  glide_.stop();
  renderer::Camera next = camera();
  next.zoom = 1.0;
  next.focus_mm.reset();
  const bool shown = proxy_.state().begun && proxy_.display().settings().surface;
  set(shown ? on_surface(next, 1.0) : next);
}

void CameraFollower::follow() {
  const engine::CaseState& state = proxy_.state();
  const double aspect = aspect_();
  if (aspect <= 0.0 || !state.begun || !state.phi) return;
  const bool ends = state.converged && !converged_;
  converged_ = state.converged;
  if (state.phi == seen_ && !ends) return;
  seen_ = state.phi;
  if (!is_own() || seen_->pages.stored() == 0) return;
  const bool moves = glide_.state() == QAbstractAnimation::Running;
  if (ends || !own_ || (!moves && !sees())) approach();
}

// Where the surface may have gone meanwhile: with a GPU it can come after the state that says that it rests.
void CameraFollower::catch_up() {
  if (seen_ == approached_ || !is_own() || seen_->pages.stored() == 0) return;
  if (converged_ || !sees()) approach();
}

bool CameraFollower::sees() const {
  return camera().sees(renderer::box_around(*seen_), proxy_.volume().geometry, aspect_());
}

void CameraFollower::approach() {
  renderer::Camera next = on_surface(camera(), converged_ ? 1.0 : kSurfaceRoom);
  if (!converged_) next.zoom = std::min(next.zoom, kNearest);
  approached_ = seen_;
  own_ ? glide_to(next) : set(next);
}

// `room`: times the surface's own extent.
renderer::Camera CameraFollower::on_surface(const renderer::Camera& from, double room) const {
  const auto& phi = proxy_.state().phi;
  if (!phi || phi->pages.stored() == 0) return from;
  renderer::Camera next = from.on(renderer::box_around(*phi), proxy_.volume().geometry, aspect_());
  next.zoom = std::clamp(next.zoom / room, kLeastZoom, kMostZoom);
  return next;
}

bool CameraFollower::is_own() const {
  return !camera().focus_mm || camera() == own_;
}

void CameraFollower::set(const renderer::Camera& camera) {
  own_ = camera;
  proxy_.display().change([&](engine::DisplaySettings& settings) { settings.camera = camera; });
}

void CameraFollower::glide_to(const renderer::Camera& to) {
  glide_.stop();
  disconnect(step_);
  const glm::dvec3 middle = renderer::middle_of(proxy_.volume().geometry);
  step_ = connect(&glide_, &QVariantAnimation::valueChanged, this,
                  [this, from = camera(), to, middle](const QVariant& share) {
                    if (!is_own()) return glide_.stop();
                    set(between(from, to, share.toDouble(), middle));
                  });
  glide_.start();
}

}  // namespace tidemark::ui
