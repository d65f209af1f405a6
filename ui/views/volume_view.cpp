#include "ui/views/volume_view.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QPointer>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "engine/label_finisher.h"
#include "ui/views/driven_by.h"
#include "ui/views/next_step.h"
#include "ui/views/orientation_cube.h"
#include "ui/views/overlay.h"
#include "ui/views/volume_box.h"

namespace tidemark::ui {
namespace {

constexpr double kDegreesPerPixel = 0.4;

// About the middle of the picture, which stays there from now on.
void zoom_to(double zoom, renderer::Camera& camera, const Geometry& geometry) {
  camera.zoom = std::clamp(zoom, kLeastZoom, kMostZoom);
  if (!camera.focus_mm) camera.focus_mm = renderer::middle_of(geometry);
}

// Never over the head or under the feet.
renderer::Camera turned_by(double azimuth, double elevation, const renderer::Camera& camera,
                           const Geometry& geometry, QSizeF view) {
  return camera.turned_to(std::remainder(camera.azimuth + azimuth, 360.0),
                          std::clamp(camera.elevation + elevation, -90.0, 90.0), geometry,
                          view.width() / view.height());
}

// Turns the camera around its focus.
class RotateDrag : public Drag {
 public:
  RotateDrag(DragView view, const Pointer& pressed) : Drag(std::move(view)), from_(pressed.position) {
    camera_ = display().settings().camera;
  }
  void move(const Pointer& pointer) override {
    const QPointF way = pointer.position - from_;
    const renderer::Camera camera = turned_by(-kDegreesPerPixel * way.x(), kDegreesPerPixel * way.y(),
                                              camera_, proxy().volume().geometry, view().size);
    display().change([&](engine::DisplaySettings& settings) { settings.camera = camera; });
  }

 private:
  QPointF from_;
  renderer::Camera camera_;
};

class CameraPanDrag : public Drag {
 public:
  CameraPanDrag(DragView view, const Pointer& pressed) : Drag(std::move(view)), from_(pressed.position) {
    camera_ = display().settings().camera;
  }
  void move(const Pointer& pointer) override {
    const QPointF way = (pointer.position - from_) * view().mm_per_pixel;
    renderer::Camera camera = camera_;
    camera.focus_mm = camera_.focus_mm.value_or(renderer::middle_of(proxy().volume().geometry)) -
                      camera_.right() * way.x() + camera_.up() * way.y();
    display().change([&](engine::DisplaySettings& settings) { settings.camera = camera; });
  }

 private:
  QPointF from_;
  renderer::Camera camera_;
};

class CameraZoomDrag : public Drag {
 public:
  CameraZoomDrag(DragView view, const Pointer& pressed) : Drag(std::move(view)), from_(pressed.position) {
    zoom_ = display().settings().camera.zoom;
  }
  void move(const Pointer& pointer) override {
    const double zoom = zoom_ * std::exp((from_.y() - pointer.position.y()) / 150.0);
    display().change([&](engine::DisplaySettings& settings) {
      zoom_to(zoom, settings.camera, proxy().volume().geometry);
    });
  }

 private:
  QPointF from_;
  double zoom_ = 1.0;
};

}  // namespace

VolumeViewWidget::VolumeViewWidget(engine::CaseProxy& proxy, QWidget* parent)
    : PictureView(proxy, parent),
      follower_(
          proxy, [this] { return isVisible() ? physical_size().aspect() : 0.0; }, this) {
  setAccessibleName(title());
  auto* next = new NextStep(proxy, *this);
  connect(next, &NextStep::place_wanted, this, &VolumeViewWidget::place_wanted);
  connect(&proxy.label_finisher(), &engine::LabelFinisher::changed, this, &VolumeViewWidget::ask);
}

std::shared_ptr<const document::Labels> VolumeViewWidget::wanted_labels() const {
  const auto& preview = proxy().label_finisher().preview();
  return preview ? preview->after : nullptr;
}

renderer::VolumeView VolumeViewWidget::view() const {
  const engine::DisplaySettings& s = settings();
  renderer::VolumeView view;
  view.mode = s.mode;
  view.camera = s.camera;
  view.surface = s.surface;
  view.surface_colour = s.surface_colour;
  const bool shows_spread = display().spread() != nullptr;
  view.colouring = shows_spread || shows_no_speed() ? renderer::SurfaceColouring::plain : s.colouring;
  view.change = shows_distances();
  view.region = s.region;
  view.label_opacity = s.label_opacity;
  view.lighting.occlusion = s.occlusion;
  view.window = s.window;
  if (s.clip_on) view.clip = s.clip;
  if (s.show_source || !s.transfer.surface.empty()) {
    view.source = s.transfer;
    if (!s.show_source) view.source->source.clear();
  }
  return view;
}

// Curvature and rescaling are known all the same.
bool VolumeViewWidget::shows_no_speed() const {
  const renderer::SurfaceColouring colouring = settings().colouring;
  return proxy().state().lacks_speed && (colouring == renderer::SurfaceColouring::total_speed ||
                                         colouring == renderer::SurfaceColouring::data);
}

VolumeScreen VolumeViewWidget::screen() const {
  return {settings().camera, QSizeF(size()), proxy().volume().geometry};
}

ClipHandles VolumeViewWidget::handles() const {
  return {settings().clip, screen(), proxy().volume().geometry};
}

// What faces away, or is cut off, is not seen; what other parts of the surface hide is.
bool VolumeViewWidget::shows(glm::dvec3 place_mm, glm::dvec3 outward) const {
  const renderer::ClipPlane& clip = settings().clip;
  const bool is_cut =
      settings().clip_on && clip.clips_surface && glm::dot(clip.normal, place_mm) > clip.offset_mm + 1e-6;
  return settings().surface && !is_cut && glm::dot(outward, screen().into()) < 0.0;
}

std::optional<glm::dvec3> VolumeViewWidget::patient_at(QPointF position) const {
  if (grip_mm_) {
    const VolumeScreen on_screen = screen();
    const glm::dvec3 facing = on_screen.into();
    return on_screen.on_plane(position, facing, glm::dot(*grip_mm_, facing));
  }
  if (!settings().clip_on) return std::nullopt;
  const auto point = screen().on_plane(position, settings().clip.normal, settings().clip.offset_mm);
  if (!point || !proxy().volume().geometry.covers(*point)) return std::nullopt;
  return point;
}

std::unique_ptr<Drag> VolumeViewWidget::begin_drag(const Pointer& pressed) {
  if (settings().clip_on && pressed.button == Qt::LeftButton) {
    if (const auto grip = handles().grip_at(pressed.position)) {
      return clip_drag(drag_view(), pressed, *grip, screen());
    }
  }
  const engine::Tool tool = settings().tool;
  const bool has_no_work = tool == engine::Tool::window || is_for_slices(tool);
  const bool turns = has_no_work && !pressed.modifiers.testFlag(Qt::AltModifier);
  if (turns) return navigation_drag(pressed);
  if (!pressed.patient_mm && pressed.button != Qt::MiddleButton) {
    const bool erases = pressed.button == Qt::RightButton;
    if (!erases || engine::has_right_button(tool)) {
      pick_and_begin(pressed);
      return nullptr;
    }
  }
  return PictureView::begin_drag(pressed);
}

// The engine finds the point under the mouse. Where there is none, the drag turns the camera.
void VolumeViewWidget::pick_and_begin(const Pointer& pressed) {
  pick(pressed.position, [this, pressed, number = ++press_number_](std::optional<glm::dvec3> hit_mm) {
    if (!this->pressed() || press_number_ != number) return;
    if (!hit_mm) return replace_drag(navigation_drag(pressed));
    grip_mm_ = hit_mm;
    Pointer there = pressed;
    there.patient_mm = hit_mm;
    replace_drag(PictureView::begin_drag(there));
  });
}

// Without an answer where the view is gone by then.
void VolumeViewWidget::pick(QPointF position, std::function<void(std::optional<glm::dvec3>)> answer) {
  const double ratio = devicePixelRatioF();
  const auto take = [self = QPointer(this), answer = std::move(answer)](std::optional<renderer::Hit> hit) {
    if (self) answer(hit ? std::optional(hit->patient_mm) : std::nullopt);
  };
  proxy().pick(view(), physical_size(), wanted_labels(), {position.x() * ratio, position.y() * ratio}, take);
}

void VolumeViewWidget::find_place(QPointF position, std::function<void(std::optional<glm::dvec3>)> answer) {
  if (const auto on_cut = patient_at(position)) return answer(on_cut);
  pick(position, std::move(answer));
}

void VolumeViewWidget::showEvent(QShowEvent* event) {
  PictureView::showEvent(event);
  follower_.follow();
}

void VolumeViewWidget::mouseMoveEvent(QMouseEvent* event) {
  PictureView::mouseMoveEvent(event);
  if (settings().clip_on) paint_again();  // the grip under the mouse
}

void VolumeViewWidget::button_lifted() {
  grip_mm_.reset();
  ++press_number_;
}

std::unique_ptr<Drag> VolumeViewWidget::navigation_drag(const Pointer& pressed) {
  if (pressed.button == Qt::MiddleButton) return std::make_unique<CameraPanDrag>(drag_view(), pressed);
  if (pressed.button == Qt::RightButton) return std::make_unique<CameraZoomDrag>(drag_view(), pressed);
  return std::make_unique<RotateDrag>(drag_view(), pressed);
}

// Through the slices of the clip plane; nearer and farther without one.
void VolumeViewWidget::scroll(int clicks) {
  if (!settings().clip_on) return zoom(std::pow(1.1, clicks), rect().center());
  const glm::dvec3 spacing = proxy().volume().geometry.spacing_mm;
  const double stride_mm = std::min({spacing.x, spacing.y, spacing.z});
  display().change([&](engine::DisplaySettings& settings) { settings.clip.offset_mm += clicks * stride_mm; });
}

void VolumeViewWidget::zoom(double factor, QPointF /*about*/) {
  display().change([&](engine::DisplaySettings& settings) {
    zoom_to(settings.camera.zoom * factor, settings.camera, proxy().volume().geometry);
  });
}

void VolumeViewWidget::keyPressEvent(QKeyEvent* event) {
  const bool tilts = event->modifiers().testFlag(Qt::ControlModifier) && settings().clip_on;
  const auto turn = [&](double azimuth, double elevation) {
    display().change([&](engine::DisplaySettings& settings) {
      if (tilts) {
        // The plane turns about the axes of the screen.
        const glm::dvec3 axis = azimuth != 0.0 ? settings.camera.up() : settings.camera.right();
        const double angle = glm::radians(azimuth != 0.0 ? azimuth : elevation);
        const glm::dvec3 n = settings.clip.normal;
        const glm::dvec3 turned = n * std::cos(angle) + glm::cross(axis, n) * std::sin(angle) +
                                  axis * (glm::dot(axis, n) * (1.0 - std::cos(angle)));
        const glm::dvec3 middle = renderer::middle_of(proxy().volume().geometry);
        const glm::dvec3 pivot = middle + n * (settings.clip.offset_mm - glm::dot(middle, n));
        settings.clip.normal = glm::normalize(turned);
        settings.clip.offset_mm = glm::dot(pivot, settings.clip.normal);
      } else {
        settings.camera =
            turned_by(azimuth, elevation, settings.camera, proxy().volume().geometry, QSizeF(size()));
      }
    });
  };
  constexpr double kTurn = 5.0;
  switch (event->key()) {
    case Qt::Key_Left:
      return turn(-kTurn, 0.0);
    case Qt::Key_Right:
      return turn(kTurn, 0.0);
    case Qt::Key_Up:
      return turn(0.0, kTurn);
    case Qt::Key_Down:
      return turn(0.0, -kTurn);
    default:
      PictureView::keyPressEvent(event);
  }
}

void VolumeViewWidget::paint_overlay(QPainter& painter) {
  const renderer::Camera& camera = settings().camera;
  if (settings().volume_box) paint_volume_box(painter, proxy().volume().geometry, screen());
  const bool is_oriented = proxy().volume().geometry.oriented;
  if (settings().orientation_cube && is_oriented) paint_orientation_cube(painter, size(), camera);
  paint_orientation(painter, size(), camera.right(), camera.up(), is_oriented);
  paint_scale_bar(painter, size(), mm_per_pixel());
  paint_study(painter);
  const renderer::VolumeView shown = view();
  const bool is_coloured = shown.surface && shown.colouring == renderer::SurfaceColouring::plain;
  if (const auto scale = scale_of_distances(); scale && is_coloured)
    paint_colour_scale(painter, size(), *scale);
  if (shows_no_speed()) paint_reason(painter, lacking_speed_text(proxy().state()));
  if (!settings().clip_on) return;
  const ClipHandles on_screen = handles();
  on_screen.paint(painter, on_screen.grip_at(mapFromGlobal(QCursor::pos())));
}

}  // namespace tidemark::ui
