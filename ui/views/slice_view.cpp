#include "ui/views/slice_view.h"
#include "engine/label_finisher.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "ui/views/driven_by.h"
#include "ui/views/mark_drags.h"
#include "ui/views/overlay.h"
#include "ui/widgets/number_text.h"

namespace tidemark::ui {
namespace {

constexpr double kLeastSliceZoom = 0.2;
constexpr double kMostSliceZoom = 40.0;
constexpr double kSwipeReach = 6.0;  // logical pixels beside the line

class PanDrag : public Drag {
 public:
  PanDrag(DragView view, const Pointer& pressed, renderer::SliceOrientation orientation)
      : Drag(std::move(view)), from_(pressed.position), orientation_(orientation) {
    centre_mm_ = display().settings().slice_centre_mm;
  }
  void move(const Pointer& pointer) override {
    const QPointF way = (pointer.position - from_) * view().mm_per_pixel;
    const glm::dvec3 centre = centre_mm_ - orientation_.right * way.x() + orientation_.up * way.y();
    display().change([&](engine::DisplaySettings& settings) { settings.slice_centre_mm = centre; });
  }

 private:
  QPointF from_;
  renderer::SliceOrientation orientation_;
  glm::dvec3 centre_mm_;
};

class ZoomDrag : public Drag {
 public:
  ZoomDrag(DragView view, const Pointer& pressed) : Drag(std::move(view)), from_(pressed.position) {
    zoom_ = display().settings().slice_zoom;
  }
  void move(const Pointer& pointer) override {
    const double zoom = std::clamp(zoom_ * std::exp((from_.y() - pointer.position.y()) / 150.0),
                                   kLeastSliceZoom, kMostSliceZoom);
    display().change([&](engine::DisplaySettings& settings) { settings.slice_zoom = zoom; });
  }

 private:
  QPointF from_;
  double zoom_ = 1.0;
};

class SwipeDrag : public Drag {
 public:
  explicit SwipeDrag(DragView view) : Drag(std::move(view)) {}
  void move(const Pointer& pointer) override {
    const double at = std::clamp(pointer.position.x() / view().size.width(), 0.0, 1.0);
    display().change([&](engine::DisplaySettings& settings) { settings.swipe_at = at; });
  }
};

// The convention is about left and right: sagittal slices have neither.
bool has_sides(const renderer::SliceOrientation& orientation) {
  const glm::dvec3 across = glm::abs(orientation.right);
  return across.x > across.y && across.x > across.z;
}

QString term_name(renderer::SpeedTerm term) {
  switch (term) {
    case renderer::SpeedTerm::total:
      return SliceViewWidget::tr("total speed");
    case renderer::SpeedTerm::data:
      return SliceViewWidget::tr("data term D");
    case renderer::SpeedTerm::curvature:
      return SliceViewWidget::tr("curvature term");
    case renderer::SpeedTerm::rescaling:
      return SliceViewWidget::tr("rescaling term");
    case renderer::SpeedTerm::doubt:
      return SliceViewWidget::tr("doubt");
  }
  return {};
}

}  // namespace

SliceViewWidget::SliceViewWidget(engine::CaseProxy& proxy, SlicePlane plane, renderer::SliceContent content,
                                 QWidget* parent)
    : PictureView(proxy, parent), plane_(plane), content_(content) {
  setAccessibleName(title());
  connect(&proxy, &engine::CaseProxy::state_changed, this, &SliceViewWidget::follow_marks);
  connect(&proxy.comparison(), &engine::StateComparison::changed, this, &SliceViewWidget::paint_again);
  connect(&proxy.label_finisher(), &engine::LabelFinisher::changed, this, &SliceViewWidget::paint_again);
  connect(&images_, &ImageOverlay::arrived, this, &SliceViewWidget::ask);
}

QString SliceViewWidget::title() const {
  QString plane;
  switch (plane_) {
    case SlicePlane::axial:
      plane = tr("Axial");
      break;
    case SlicePlane::coronal:
      plane = tr("Coronal");
      break;
    case SlicePlane::sagittal:
      plane = tr("Sagittal");
      break;
    case SlicePlane::oblique:
      plane = tr("Oblique");
      break;
  }
  if (content_ == renderer::SliceContent::speed) return tr("Speed map, %1").arg(plane.toLower());
  if (content_ == renderer::SliceContent::pages) return tr("Pages, %1").arg(plane.toLower());
  return plane;
}

renderer::SliceOrientation SliceViewWidget::radiological() const {
  if (plane_ == SlicePlane::coronal) return renderer::kCoronal;
  if (plane_ == SlicePlane::sagittal) return renderer::kSagittal;
  return plane_ == SlicePlane::oblique ? settings().oblique : renderer::kAxial;
}

renderer::SliceOrientation SliceViewWidget::orientation() const {
  renderer::SliceOrientation orientation = radiological();
  if (!settings().radiological && has_sides(orientation)) orientation.right = -orientation.right;
  return orientation;
}

renderer::SliceView SliceViewWidget::slice() const {
  const engine::DisplaySettings& s = settings();
  renderer::SliceView view;
  view.orientation = orientation();
  view.position_mm = s.cursor_mm;
  view.zoom = s.slice_zoom;
  const glm::dvec3 shift = s.slice_centre_mm - renderer::middle_of(proxy().volume().geometry);
  view.pan_mm = {glm::dot(shift, view.orientation.right), glm::dot(shift, view.orientation.up)};
  view.content = content_;
  // Without a function the map of the doubt is the dimmed slice.
  view.term = shows_no_speed() ? renderer::SpeedTerm::doubt : s.speed_term;
  view.window = s.window;
  view.nearest = s.nearest;
  view.surface = s.outline;
  view.contours = s.contours;
  view.change = shows_distances() && !display().spread();
  view.line_pixels = s.line_pixels * devicePixelRatioF();
  view.label_opacity = s.label_opacity;
  return view;
}

renderer::SliceView SliceViewWidget::fused_slice() const {
  renderer::SliceView view = slice();
  if (content_ != renderer::SliceContent::source) return view;
  std::vector<engine::ShownImage> over = settings().images;
  if (const auto& agreement = display().agreement()) {
    over.push_back(*agreement);
    view.surface = false;  // it has the colour of what all runs agree on, and hides where they begin not to
  }
  images_.ask(over, view, screen(), size());
  const auto& newest = images_.newest();
  if (newest && newest->size == size() && newest->slice.orientation == view.orientation) {
    view.position_mm = newest->slice.position_mm;
    view.zoom = newest->slice.zoom;
    view.pan_mm = newest->slice.pan_mm;
    view.images = newest->over;
  }
  if (const auto line = swipe_line()) view.images_from = *line / width();
  return view;
}

std::optional<double> SliceViewWidget::swipe_line() const {
  const engine::DisplaySettings& s = settings();
  if (!s.swipe || s.images.empty() || content_ != renderer::SliceContent::source) return std::nullopt;
  return s.swipe_at * width();
}

SliceScreen SliceViewWidget::screen() const {
  return {slice(), QSizeF(size()), proxy().volume().geometry};
}

QPointF SliceViewWidget::position_of(glm::dvec3 patient_mm) const {
  return screen().position_of(patient_mm);
}

std::optional<glm::dvec3> SliceViewWidget::patient_at(QPointF position) const {
  return screen().patient_at(position);
}

bool SliceViewWidget::shows(glm::dvec3 place_mm, glm::dvec3 /*outward*/) const {
  return slab()->is_near(place_mm);
}

std::optional<solver::PlaneSlab> SliceViewWidget::force_slab() const {
  const glm::dvec3 into = orientation().into();
  return solver::PlaneSlab{into, glm::dot(into, settings().cursor_mm), 0.5 * place().thickness_mm};
}

std::optional<engine::SliceSlab> SliceViewWidget::slab() const {
  return engine::SliceSlab(proxy().volume().geometry, settings().cursor_mm, orientation().into());
}

SliceViewWidget::Place SliceViewWidget::place() const {
  const Geometry& geometry = proxy().volume().geometry;
  const glm::dvec3 into = radiological().into();
  // Slices of an oblique view are as far apart as the voxels are along its normal.
  double extent_mm = 0.0;
  double spacing_mm = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double share = std::abs(glm::dot(into, geometry.direction[axis]));
    extent_mm += share * geometry.spacing_mm[axis] * static_cast<double>(geometry.size[axis] - 1);
    spacing_mm += share * share * geometry.spacing_mm[axis];
  }
  const double from_middle = glm::dot(settings().cursor_mm - renderer::middle_of(geometry), into);
  Place place;
  place.thickness_mm = spacing_mm;
  place.slices = std::llround(extent_mm / spacing_mm) + 1;
  place.slice = std::clamp<std::int64_t>(std::llround((from_middle + 0.5 * extent_mm) / spacing_mm) + 1, 1,
                                         place.slices);
  return place;
}

QString SliceViewWidget::acquired_number() const {
  const auto& numbers = proxy().study().slice_numbers;
  const auto slice = acquired_slice(proxy().volume().geometry, orientation(), settings().cursor_mm);
  if (!slice || static_cast<std::size_t>(*slice) >= numbers.size()) return {};
  const imaging::SliceNumber& number = numbers[static_cast<std::size_t>(*slice)];
  QStringList parts;
  if (number.instance) parts << tr("instance %1").arg(*number.instance);
  if (number.frame) parts << tr("frame %1").arg(*number.frame);
  return parts.join(QLatin1String(", "));
}

void SliceViewWidget::scroll(int clicks) {
  const Place now = place();
  const std::int64_t slice = std::clamp<std::int64_t>(now.slice + clicks, 1, now.slices);
  const glm::dvec3 into = radiological().into();
  const double way_mm = static_cast<double>(slice - now.slice) * now.thickness_mm;
  display().change([&](engine::DisplaySettings& settings) { settings.cursor_mm += into * way_mm; });
}

void SliceViewWidget::zoom(double factor, QPointF about) {
  // The point under the mouse stays there.
  const glm::dvec3 point = screen().patient_at(about);
  display().change([&](engine::DisplaySettings& s) {
    const double zoom = std::clamp(s.slice_zoom * factor, kLeastSliceZoom, kMostSliceZoom);
    const renderer::SliceOrientation o = orientation();
    const glm::dvec3 way = point - s.slice_centre_mm;
    const double share = 1.0 - s.slice_zoom / zoom;
    s.slice_centre_mm += (o.right * glm::dot(way, o.right) + o.up * glm::dot(way, o.up)) * share;
    s.slice_zoom = zoom;
  });
}

// The line comes before the tool.
std::unique_ptr<Drag> SliceViewWidget::begin_drag(const Pointer& pressed) {
  const auto line = swipe_line();
  if (line && pressed.button == Qt::LeftButton && std::abs(pressed.position.x() - *line) <= kSwipeReach)
    return std::make_unique<SwipeDrag>(drag_view());
  return PictureView::begin_drag(pressed);
}

Qt::CursorShape SliceViewWidget::cursor_at(QPointF position) const {
  const auto line = swipe_line();
  if (line && std::abs(position.x() - *line) <= kSwipeReach) return Qt::SplitHCursor;
  return PictureView::cursor_at(position);
}

std::unique_ptr<Drag> SliceViewWidget::navigation_drag(const Pointer& pressed) {
  if (pressed.button == Qt::MiddleButton)
    return std::make_unique<PanDrag>(drag_view(), pressed, orientation());
  if (pressed.button == Qt::RightButton) return std::make_unique<ZoomDrag>(drag_view(), pressed);
  return nullptr;
}

void SliceViewWidget::paint_overlay(QPainter& painter) {
  const SliceScreen on_screen = screen();
  const renderer::SliceOrientation o = orientation();
  paint_swipe_line(painter);
  paint_truth(painter, on_screen);
  paint_compared(painter, on_screen);
  paint_preview(painter, on_screen);
  paint_marks(painter, on_screen);
  if (settings().crosshair) paint_crosshair(painter, size(), on_screen.position_of(settings().cursor_mm));
  paint_measurements(painter, settings().measurements, on_screen, *slab());
  if (settings().profile) paint_profile(painter, *settings().profile, on_screen, *slab());
  paint_orientation(painter, size(), o.right, o.up, proxy().volume().geometry.oriented);
  paint_scale_bar(painter, size(), on_screen.mm_per_pixel());
  paint_corners(painter);
  paint_legend(painter);
}

void SliceViewWidget::paint_legend(QPainter& painter) const {
  const auto& agreement = display().agreement();
  if (content_ == renderer::SliceContent::source && agreement)
    return paint_colour_scale(painter, size(), scale_of_agreement(agreement->window.width));
  const bool has_distances = content_ == renderer::SliceContent::source && !display().spread();
  if (const auto scale = scale_of_distances(); scale && has_distances)
    return paint_colour_scale(painter, size(), *scale);
  if (content_ != renderer::SliceContent::speed) return;
  if (shows_no_speed()) return paint_reason(painter, lacking_speed_text(proxy().state()));
  if (settings().speed_term != renderer::SpeedTerm::doubt) return;
  const auto& speed = proxy().state().speed;
  if (speed && speed->has_doubt()) return paint_colour_scale(painter, size(), scale_of_doubt());
  paint_reason(painter, tr("Only a speed function that learns from examples has a doubt."));
}

// Curvature and rescaling are known all the same.
bool SliceViewWidget::shows_no_speed() const {
  const renderer::SpeedTerm term = settings().speed_term;
  return content_ == renderer::SliceContent::speed && proxy().state().lacks_speed &&
         term != renderer::SpeedTerm::curvature && term != renderer::SpeedTerm::rescaling;
}

void SliceViewWidget::paint_swipe_line(QPainter& painter) const {
  const auto line = swipe_line();
  if (!line) return;
  constexpr double kGrip = 5.0;
  const QPointF middle(*line, 0.5 * height());
  paint_line(painter, {QPointF(*line, 0.0), QPointF(*line, height())});
  painter.setBrush(Qt::white);
  painter.drawEllipse(middle, kGrip, kGrip);
}

void SliceViewWidget::paint_truth(QPainter& painter, const SliceScreen& on_screen) {
  const auto& truth = proxy().truth();
  if (!settings().truth || !truth) return;
  truth_outline_.paint(painter, truth, orientation(), settings().cursor_mm, on_screen, kTruthColour);
}

void SliceViewWidget::paint_compared(QPainter& painter, const SliceScreen& on_screen) {
  if (content_ == renderer::SliceContent::pages) return;
  compared_outline_.paint(painter, proxy().comparison().phi(), orientation(), settings().cursor_mm, on_screen,
                          kComparedColour);
}

QString SliceViewWidget::compared_text() const {
  const auto compared = proxy().comparison().state();
  if (!compared || content_ == renderer::SliceContent::pages) return {};
  const auto* row = engine::find_row(*proxy().state().history, *compared);
  return row ? tr("Turquoise: step %1").arg(row->state.steering.step) : QString();
}

void SliceViewWidget::paint_preview(QPainter& painter, const SliceScreen& on_screen) {
  if (content_ != renderer::SliceContent::source) return;
  preview_outline_.paint(painter, proxy().label_finisher().preview(), orientation(), settings().cursor_mm,
                         on_screen, kPreviewColour);
  stroke_outline_.paint(painter, display().drawn_label(), orientation(), settings().cursor_mm, on_screen,
                        kPreviewColour);
}

engine::DrawnMarks SliceViewWidget::marks() const {
  if (const auto& drawn = display().drawn_marks()) return *drawn;
  return {proxy().drive().strokes, proxy().drive().constraints};
}

void SliceViewWidget::paint_marks(QPainter& painter, const SliceScreen& on_screen) {
  const engine::DrawnMarks now = marks();
  if (settings().marks) {
    marks_overlay_.paint(painter, now, proxy().volume().geometry, orientation(), settings().cursor_mm,
                         on_screen);
  }
  if (settings().tool != engine::Tool::examples || !underMouse()) return;
  const QString missing = missing_examples(now.strokes.get());
  if (missing.isEmpty()) return;
  const QRectF where(0.05 * width(), 0.7 * height(), 0.9 * width(), 0.15 * height());
  paint_text(painter, where, Qt::AlignHCenter | Qt::AlignVCenter | Qt::TextWordWrap, missing);
}

// Undo, or a session, has brought others.
void SliceViewWidget::follow_marks() {
  const engine::DrawnMarks now = marks();
  if (now == marks_) return;
  marks_ = now;
  paint_again();
}

void SliceViewWidget::paint_corners(QPainter& painter) const {
  const engine::DisplaySettings& s = settings();
  const bool sides_are_known = has_sides(radiological()) && proxy().volume().geometry.oriented;
  const QString convention = s.radiological ? tr("radiological") : tr("neurological");
  paint_study(painter, sides_are_known ? convention : QString());
  const Place now = place();
  QStringList lines;
  lines << tr("%1 / %2   %3 mm").arg(now.slice).arg(now.slices).arg(general_text(now.thickness_mm, 3));
  if (const QString number = acquired_number(); !number.isEmpty()) lines << number;
  if (content_ == renderer::SliceContent::source) {
    const int decimals = decimals_for(proxy().summary().high - proxy().summary().low);
    lines << tr("W %1  L %2")
                 .arg(number_text(s.window.width, decimals), number_text(s.window.centre, decimals));
  }
  if (content_ == renderer::SliceContent::speed) lines << term_name(s.speed_term);
  if (const QString compared = compared_text(); !compared.isEmpty()) lines << compared;
  lines << tr("Zoom %1 %").arg(number_text(100.0 * s.slice_zoom, 0));
  paint_corner(painter, size(), Qt::AlignLeft | Qt::AlignBottom, lines);
}

}  // namespace tidemark::ui
