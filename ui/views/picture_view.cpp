#include "ui/views/picture_view.h"

#include <QKeyEvent>
#include <QMdiArea>
#include <QMdiSubWindow>
#include <QMouseEvent>
#include <QPainter>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "engine/case_balance.h"
#include "engine/surface_maps.h"
#include "solver/speed/motion_limit.h"
#include "ui/views/force_arrows.h"
#include "ui/views/overlay.h"
#include "ui/views/picture_surface.h"

namespace tidemark::ui {
namespace {

constexpr int kWheelClick = 120;  // eighths of a degree (Qt)
constexpr double kZoomStep = 1.15;
constexpr double kSmallestBrush = 0.2;  // mm
constexpr double kLargestBrush = 200.0;
constexpr double kSmallestStroke = 0.5;  // voxels
constexpr double kLargestStroke = 50.0;
constexpr double kForceDistance = 16.0;  // logical pixels between arrows
constexpr double kClickReach = 5.0;      // logical pixels: a hand is not quite still

Qt::CursorShape cursor_for(engine::Tool tool) {
  switch (tool) {
    case engine::Tool::window:
      return Qt::ArrowCursor;
    case engine::Tool::paint:
    case engine::Tool::erase:
    case engine::Tool::seed:
    case engine::Tool::crosshair:
    case engine::Tool::probe_speed:
    case engine::Tool::probe_transfer:
    case engine::Tool::measure_distance:
    case engine::Tool::measure_angle:
    case engine::Tool::profile:
    case engine::Tool::examples:
    case engine::Tool::wall:
    case engine::Tool::label:
      return Qt::CrossCursor;
    case engine::Tool::why:
      return Qt::WhatsThisCursor;
  }
  return Qt::ArrowCursor;
}

// Of a case; true outside of any.
bool is_in_active_window(const QWidget& view) {
  for (QWidget* parent = view.parentWidget(); parent; parent = parent->parentWidget()) {
    auto* window = qobject_cast<QMdiSubWindow*>(parent);
    if (window && window->mdiArea()) return window->mdiArea()->activeSubWindow() == window;
  }
  return true;
}

}  // namespace

bool PictureView::shows_distances() const {
  const engine::SurfaceMap shown = proxy().state().surface_map;
  if (shown != proxy().wanted_surface_map()) return false;
  return shown != engine::SurfaceMap::none || settings().change;
}

std::optional<ColourScale> PictureView::scale_of_distances() const {
  if (!shows_distances()) return std::nullopt;
  const double range_mm = engine::distance_range_mm(proxy().volume().geometry);
  const engine::CaseState& state = proxy().state();
  if (state.surface_map == engine::SurfaceMap::truth_error) return scale_of_truth_error(range_mm);
  if (state.surface_map == engine::SurfaceMap::spread) return scale_of_spread(range_mm);
  return state.limit ? std::optional(scale_of_change(state.limit->within_mm())) : std::nullopt;
}

PictureView::PictureView(engine::CaseProxy& proxy, QWidget* parent)
    : QWidget(parent), proxy_(proxy), feed_(proxy) {
  setMouseTracking(true);
  setFocusPolicy(Qt::StrongFocus);
  setAttribute(Qt::WA_OpaquePaintEvent);
  setLayoutDirection(Qt::LeftToRight);  // left and right are the patient's, however people write
  if (proxy.engine().pictures() == engine::Engine::Pictures::textures) {
    surface_ = new PictureSurface(
        feed_, [this](QPainter& painter) { paint_all(painter); }, this);
  }
  connect(&feed_, &engine::PictureFeed::arrived, this, &PictureView::paint_again);
  connect(&display(), &engine::Display::changed, this, &PictureView::follow_display);
  connect(&display(), &engine::Display::pointer_moved, this, &PictureView::paint_again);
  connect(&proxy.balance(), &engine::CaseBalance::changed, this, &PictureView::paint_again);
  connect(&proxy, &engine::CaseProxy::state_changed, this, &PictureView::follow_state);
  connect(&forces_, &engine::ForceSampler::answered, this, &PictureView::paint_again);
  follow_display();
}

PictureView::~PictureView() {
  gesture_.stop();  // it speaks to all views, this one included
}

renderer::PictureSize PictureView::physical_size() const {
  const double ratio = devicePixelRatioF();
  return {std::llround(width() * ratio), std::llround(height() * ratio)};
}

QImage PictureView::grab_picture() {
  const auto paint = [this](QPainter& painter) {
    painter.setLayoutDirection(Qt::LeftToRight);  // left and right are the patient's
    painter.setRenderHint(QPainter::Antialiasing);
    paint_picture(painter);
    paint_overlay(painter);
    paint_balance(painter);
  };
  if (surface_) return surface_->grab(paint);
  const renderer::PictureSize size = physical_size();
  QImage image(static_cast<int>(size.width), static_cast<int>(size.height), QImage::Format_RGB32);
  image.setDevicePixelRatio(devicePixelRatioF());
  QPainter painter(&image);
  paint(painter);
  return image;
}

DragView PictureView::drag_view() {
  return {proxy_, QSizeF(size()), mm_per_pixel(), [this](glm::dvec3 point) { return position_of(point); },
          slab()};
}

Qt::CursorShape PictureView::cursor_at(QPointF /*position*/) const {
  return cursor_for(settings().tool);
}

void PictureView::ask() {
  if (is_seen() && width() > 0 && height() > 0) feed_.request(wanted(), physical_size(), wanted_labels());
}

void PictureView::set_covered(bool covered) {
  if (std::exchange(covered_, covered) == covered) return;
  if (covered) feed_.withdraw();
  ask();
  follow_forces();
}

void PictureView::follow_display() {
  gesture_.keep_to(ground());
  setCursor(cursor_at(mouse_));
  // Another slice has come under the mouse.
  if (underMouse() && slab()) display().set_pointer(patient_at(mouse_));
  ask();
  follow_forces();
  paint_again();
}

// Pictures of the surface are drawn anew without being asked for; what else is seen of the state is not.
void PictureView::follow_state() {
  const engine::CaseState& state = proxy_.state();
  const bool has_other_map = std::exchange(surface_map_, state.surface_map) != state.surface_map;
  const bool has_other_speed = std::exchange(lacks_speed_, state.lacks_speed) != state.lacks_speed;
  if (has_other_map || has_other_speed) {
    ask();
    paint_again();
  }
  follow_forces();
}

// Painting.

void PictureView::paint_again() {
  if (surface_) {
    surface_->update();
  } else {
    update();
  }
}

void PictureView::paintEvent(QPaintEvent* /*event*/) {
  if (surface_) return;
  QPainter painter(this);
  paint_all(painter);
}

void PictureView::paint_all(QPainter& painter) {
  painter.setLayoutDirection(Qt::LeftToRight);
  painter.setRenderHint(QPainter::Antialiasing);
  paint_picture(painter);
  paint_overlay(painter);
  paint_balance(painter);
  if (const auto brush = ring()) paint_circle(painter, brush->centre, brush->radius, brush->erases);
  const Drag* drag = gesture_.drag();
  if (!drag) return;
  drag->paint(painter);
  paint_text(painter, QRectF(mouse_ + QPointF(16, 10), QSizeF(240, 18)), Qt::AlignLeft | Qt::AlignVCenter,
             drag->text());
}

void PictureView::paint_picture(QPainter& painter) {
  if (feed_.shown().texture) return;  // the surface has shown it
  const QImage& image = feed_.shown().image;
  if (!image.isNull()) {
    // Coarse pictures are enlarged while something moves.
    painter.setRenderHint(QPainter::SmoothPixmapTransform, image.size() != size() * devicePixelRatioF());
    painter.drawImage(QRectF(rect()), image);
    return;
  }
  painter.fillRect(rect(), QColor(18, 20, 24));
}

void PictureView::paint_study(QPainter& painter, const QString& note) const {
  constexpr int kLines = 8;  // three above, three below, and the letters between them
  const bool is_low = height() < kLines * fontMetrics().height();
  QStringList upper_right;
  if (settings().patient_text) {
    const engine::LoadedStudy& study = proxy_.study();
    const QStringList patient = patient_lines(study.patient);
    paint_corner(painter, size(), Qt::AlignLeft | Qt::AlignTop, is_low ? patient.mid(0, 1) : patient);
    if (!is_low) upper_right = series_lines(study);
  }
  if (!note.isEmpty()) upper_right << note;
  paint_corner(painter, size(), Qt::AlignRight | Qt::AlignTop, upper_right);
}

void PictureView::paint_reason(QPainter& painter, const QString& reason) const {
  const QRectF middle(0.0, 0.0, width(), 0.8 * height());
  paint_text(painter, middle, Qt::AlignHCenter | Qt::AlignBottom | Qt::TextWordWrap, reason);
}

std::optional<PictureView::Ring> PictureView::ring() const {
  std::optional<engine::DrawnSphere> shown = display().drawn_sphere();
  const auto& pointer = display().pointer_mm();
  if (pointer && settings().tool == engine::Tool::examples) {
    // In the slice under the mouse alone: a stroke is in no other.
    const auto here = slab();
    if (!here || !underMouse()) return std::nullopt;
    return Ring{position_of(*pointer), settings().stroke_voxels * here->finest_mm() / mm_per_pixel(), false};
  }
  if (settings().tool == engine::Tool::label && display().label_brush().way != engine::LabelWay::brush &&
      slab())
    return std::nullopt;  // the mouse goes around what is painted
  if (!shown && pointer && !gesture_.drag() && engine::has_right_button(settings().tool)) {
    shown = engine::DrawnSphere{{*pointer, settings().brush_mm}, settings().tool == engine::Tool::erase};
  }
  if (!shown) return std::nullopt;
  const auto& [centre_mm, radius_mm] = shown->sphere;
  const double off_mm = glm::distance(centre_mm, patient_at(position_of(centre_mm)).value_or(centre_mm));
  const double square = radius_mm * radius_mm - off_mm * off_mm;
  if (square <= 0.0) return std::nullopt;
  return Ring{position_of(centre_mm), std::sqrt(square) / mm_per_pixel(), shown->erases};
}

// The pushes of the terms.

void PictureView::follow_forces() {
  const auto inputs = engine::step_inputs(proxy_.state());
  if (!settings().forces || !is_seen() || !inputs) return forces_.forget();
  forces_.ask({*inputs, force_slab(), kForceDistance * mm_per_pixel()});
}

void PictureView::paint_balance(QPainter& painter) const {
  const SurfaceScreen on_screen{
      [this](glm::dvec3 place) { return position_of(place); },
      [this](glm::dvec3 place, glm::dvec3 outward) { return shows(place, outward); }, mm_per_pixel(),
      QSizeF(size())};
  const glm::dvec3 spacing = proxy_.volume().geometry.spacing_mm;
  const double spacing_mm = std::min({spacing.x, spacing.y, spacing.z});
  if (settings().forces) paint_forces(painter, forces_.forces(), spacing_mm, on_screen);
  if (const auto& place = proxy_.balance().place()) paint_explained_place(painter, *place, on_screen);
}

// The engine looks for the place in 3D: one search at a time.
void PictureView::explain_at(QPointF position) {
  if (std::exchange(explaining_, true)) return;
  find_place(position, [this](std::optional<glm::dvec3> place_mm) {
    explaining_ = false;
    if (place_mm) proxy_.balance().ask_in_passing(*place_mm);
  });
}

void PictureView::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  if (surface_) surface_->setGeometry(rect());
  ask();
  follow_forces();
}

void PictureView::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  ask();
  follow_forces();
}

// A level set that plays is drawn for those views alone that somebody sees.
void PictureView::hideEvent(QHideEvent* event) {
  QWidget::hideEvent(event);
  feed_.withdraw();
}

bool PictureView::event(QEvent* event) {
  // In a gesture keys are the gesture's, before they are those of actions.
  if (event->type() == QEvent::ShortcutOverride &&
      gesture_.takes(static_cast<const QKeyEvent*>(event)->key()))
    event->accept();
  // Another screen has other pixels.
  if (event->type() == QEvent::ScreenChangeInternal) ask();
  return QWidget::event(event);
}

// The mouse.

Pointer PictureView::pointer_at(const QMouseEvent& event) const {
  return {event.position(), event.button() != Qt::NoButton ? event.button() : gesture_.button(),
          event.modifiers(), patient_at(event.position())};
}

Gesture::Ground PictureView::ground() const {
  return {settings().tool, display().label_brush().way, slab()};
}

void PictureView::replace_drag(std::unique_ptr<Drag> drag) {
  gesture_.replace(std::move(drag));
  paint_again();
}

std::unique_ptr<Drag> PictureView::begin_drag(const Pointer& pressed) {
  const engine::Tool tool = settings().tool;
  if (pressed.button == Qt::LeftButton && pressed.modifiers.testFlag(Qt::AltModifier)) {
    return window_drag(drag_view(), pressed);
  }
  const bool with_tool = pressed.button == Qt::LeftButton ||
                         (pressed.button == Qt::RightButton && engine::has_right_button(tool));
  if (with_tool && !only_activates_) {
    if (auto drag = tool_drag(tool, drag_view(), pressed)) return drag;
  }
  return navigation_drag(pressed);
}

void PictureView::mousePressEvent(QMouseEvent* event) {
  // The press that makes another case active changes nothing in it.
  only_activates_ = std::exchange(brings_forward_, false) && engine::has_right_button(settings().tool);
  if (gesture_.is_held()) return;  // one gesture at a time
  gesture_.keep_to(ground());
  if (gesture_.waits_for_click()) {
    if (only_activates_) return;
    gesture_.press(pointer_at(*event));
    return paint_again();
  }
  pressed_at_ = mouse_ = event->position();
  // A brush has something to do at once.
  const engine::Tool tool = settings().tool;
  const bool is_brush = engine::has_right_button(tool) && tool != engine::Tool::seed;
  may_be_click_ = event->button() == Qt::RightButton && !is_brush;
  gesture_.begin(nullptr, event->button(), ground());
  replace_drag(begin_drag(pointer_at(*event)));
}

void PictureView::lift(bool counts) {
  may_be_click_ = false;
  gesture_.lift(counts);
  button_lifted();
  paint_again();
}

void PictureView::mouseMoveEvent(QMouseEvent* event) {
  // A dialog that opens under a held button takes its release.
  if (gesture_.is_held() && !event->buttons().testFlag(gesture_.button())) lift(true);
  mouse_ = event->position();
  if (!gesture_.drag()) setCursor(cursor_at(mouse_));
  const Pointer pointer = pointer_at(*event);
  display().set_pointer(pointer.patient_mm);
  const QPointF way = mouse_ - pressed_at_;
  may_be_click_ = may_be_click_ && std::hypot(way.x(), way.y()) < kClickReach;
  if (may_be_click_) return;
  if (Drag* drag = gesture_.drag()) {
    drag->move(pointer);
    paint_again();
  } else if (!pressed() && event->modifiers().testFlag(Qt::ShiftModifier) && pointer.patient_mm) {
    display().change([&](engine::DisplaySettings& settings) { settings.cursor_mm = *pointer.patient_mm; });
  } else if (!pressed() && event->modifiers() == Qt::ControlModifier &&
             !engine::has_right_button(settings().tool)) {
    explain_at(mouse_);
  } else if (!pressed()) {
    proxy_.balance().passed();
  }
}

void PictureView::mouseReleaseEvent(QMouseEvent* event) {
  if (event->button() != gesture_.button()) return;
  const bool clicked = may_be_click_;
  lift(!clicked);
  if (clicked) ask_for_menu(event->position());
}

// Platforms speak of the mouse at the press already; by then it may become a drag.
void PictureView::contextMenuEvent(QContextMenuEvent* event) {
  event->accept();
  if (event->reason() == QContextMenuEvent::Keyboard) ask_for_menu_by_key();
}

void PictureView::ask_for_menu(QPointF position) {
  find_place(position, [this, position](std::optional<glm::dvec3> place_mm) {
    emit menu_wanted(position.toPoint(), place_mm);
  });
}

// At the crosshair, where it is seen.
void PictureView::ask_for_menu_by_key() {
  const QPointF crosshair = position_of(settings().cursor_mm);
  const QRectF all(rect());
  ask_for_menu(all.contains(crosshair) ? crosshair : all.center());
}

void PictureView::find_place(QPointF position, std::function<void(std::optional<glm::dvec3>)> answer) {
  answer(patient_at(position));
}

void PictureView::mouseDoubleClickEvent(QMouseEvent* event) {
  const engine::Tool tool = settings().tool;
  // The second click of one that ended an outline begins no other.
  if (gesture_.take_ended_by_click()) return;
  // Dots are painted one quickly after the other.
  if (tool == engine::Tool::examples || tool == engine::Tool::wall || tool == engine::Tool::label)
    return mousePressEvent(event);
  if (event->button() == Qt::LeftButton && !engine::has_right_button(tool)) emit maximise_wanted();
}

void PictureView::leaveEvent(QEvent* event) {
  QWidget::leaveEvent(event);
  explaining_ = false;  // a search that failed has no answer
  gesture_.leave();
  display().set_pointer(std::nullopt);
}

void PictureView::focusInEvent(QFocusEvent* event) {
  QWidget::focusInEvent(event);
  // The window of the case comes to the front after this.
  brings_forward_ = event->reason() == Qt::MouseFocusReason && !is_in_active_window(*this);
  emit activated();
}

void PictureView::wheelEvent(QWheelEvent* event) {
  // Shift turns the wheel sideways on some platforms.
  const QPoint angle = event->angleDelta();
  wheel_remainder_ += angle.y() != 0 ? angle.y() : angle.x();
  const int clicks = wheel_remainder_ / kWheelClick;
  wheel_remainder_ -= clicks * kWheelClick;
  event->accept();
  if (clicks == 0) return;
  if (gesture_.holds_slice() && slab() && !event->modifiers().testFlag(Qt::ControlModifier))
    return;  // its slice stays
  if (event->modifiers().testFlag(Qt::ControlModifier)) {
    zoom(std::pow(kZoomStep, clicks), event->position());
  } else if (event->modifiers().testFlag(Qt::ShiftModifier)) {
    display().change([&](engine::DisplaySettings& settings) {
      const double factor = std::pow(1.1, clicks);
      if (settings.tool == engine::Tool::examples) {
        settings.stroke_voxels = std::clamp(settings.stroke_voxels * factor, kSmallestStroke, kLargestStroke);
      } else {
        settings.brush_mm = std::clamp(settings.brush_mm * factor, kSmallestBrush, kLargestBrush);
      }
    });
  } else {
    scroll(clicks);
  }
}

void PictureView::keyPressEvent(QKeyEvent* event) {
  const bool waits = gesture_.waits_for_click() && gesture_.holds_slice();
  if (waits || gesture_.takes(event->key())) {
    gesture_.press_key(event->key());
    return paint_again();
  }
  switch (event->key()) {
    case Qt::Key_Up:
      return scroll(1);
    case Qt::Key_Down:
      return scroll(-1);
    case Qt::Key_PageUp:
      return scroll(10);
    case Qt::Key_PageDown:
      return scroll(-10);
    case Qt::Key_Plus:
    case Qt::Key_Equal:
      return zoom(kZoomStep, rect().center());
    case Qt::Key_Minus:
      return zoom(1.0 / kZoomStep, rect().center());
    case Qt::Key_Return:
    case Qt::Key_Enter:
      return emit maximise_wanted();
    case Qt::Key_Menu:
      return ask_for_menu_by_key();
    case Qt::Key_F10:
      if (event->modifiers() == Qt::ShiftModifier) return ask_for_menu_by_key();
      return QWidget::keyPressEvent(event);
    default:
      QWidget::keyPressEvent(event);
  }
}

}  // namespace tidemark::ui
