// The display of a case and its tools: one model that all its views and panels share.
#pragma once

#include <QObject>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "core/result.h"
#include "document/agreement.h"
#include "engine/label_preview.h"
#include "engine/measurement.h"
#include "engine/shown_image.h"
#include "renderer/views.h"
#include "solver/speed/constraints.h"
#include "solver/speed/strokes.h"
#include "solver/sphere.h"

namespace tidemark::engine {

// The tool of the left button in a view.
enum class Tool {
  window,          // window and level
  crosshair,       // moves the linked cursor
  probe_speed,     // T and epsilon from the values under a drag (paper section 6.2)
  probe_transfer,  // centre and width of the chosen Gaussian
  seed,            // spheres to start from: press for the centre, drag for the radius
  paint,           // adds; the right button erases
  erase,           // erases; the right button adds
  measure_distance,
  measure_angle,
  profile,   // phi and brightness along a line
  examples,  // strokes: the left button inside, the right one outside
  wall,      // keeps the surface out; the right button takes walls and anchors away
  why,       // explains how the surface moves where it is clicked
  label,     // paints a label; the right button takes away from it
};
inline constexpr int kTools = static_cast<int>(Tool::label) + 1;  // how many there are

// Tools whose right button changes something, too.
[[nodiscard]] bool has_right_button(Tool tool);

struct DisplaySettings {
  // Slices.
  glm::dvec3 cursor_mm{0.0};        // the linked crosshair (LPS): every slice goes through it
  glm::dvec3 slice_centre_mm{0.0};  // the middle of the slices, seen along their normal
  double slice_zoom = 1.0;
  renderer::SliceOrientation oblique = renderer::kAxial;  // of oblique views
  WindowLevel window;
  bool nearest = false;
  bool outline = true;
  bool contours = false;  // of phi
  double line_pixels = 2.0;
  double label_opacity = 0.4;
  bool crosshair = true;
  bool marks = true;                                           // strokes, walls and anchors
  bool change = true;                                          // of a mask that is refined
  bool forces = false;                                         // arrows of the terms, in 3D, too
  bool truth = false;                                          // the outline of the known answer
  bool truth_error = false;                                    // how far the surface is from it, in colours
  renderer::SpeedTerm speed_term = renderer::SpeedTerm::data;  // of the speed map
  bool radiological = true;        // the patient's right on the left of the screen
  bool patient_text = true;        // names and dates in the corners
  std::vector<ShownImage> images;  // over the slices, the last one on top
  bool swipe = false;              // left of a line slices show the study alone
  double swipe_at = 0.5;           // that line, as a part of a view's width

  // 3D.
  renderer::Camera camera;
  renderer::Mode mode = renderer::Mode::raycast;
  bool surface = true;
  glm::vec4 surface_colour{0.93F, 0.72F, 0.45F, 1.0F};
  renderer::SurfaceColouring colouring = renderer::SurfaceColouring::plain;
  bool show_source = false;
  renderer::TransferFunction transfer;  // of source and surface
  renderer::Region region = renderer::Region::everywhere;
  double occlusion = 0.0;
  bool orientation_cube = true;
  bool volume_box = true;  // the volume's edges
  bool clip_on = false;
  renderer::ClipPlane clip;

  // The mouse.
  Tool tool = Tool::window;
  Tool last_tool = Tool::crosshair;  // Space goes back to it
  double brush_mm = 5.0;             // radius
  double stroke_voxels = 2.5;        // radius of a stroke, in voxels of the slice
  std::int64_t stroke_steps = 0;     // by which the surface moves after a stroke, and pauses; 0: it does not
  bool wall_behind_eraser = false;   // what is erased does not grow back
  int chosen_primitive = 0;          // of transfer.source: probing sets it
  std::vector<Measurement> measurements;
  std::optional<Measurement> profile;  // the line, a distance, along which values are plotted

  bool operator==(const DisplaySettings&) const = default;
};

// A sphere that adds to the level set or takes from it, before it does.
struct DrawnSphere {
  solver::Sphere sphere;
  bool erases = false;

  bool operator==(const DrawnSphere&) const = default;
};

// Strokes, walls and anchors as a drag is about to leave them.
struct DrawnMarks {
  std::shared_ptr<const solver::Strokes> strokes;
  std::shared_ptr<const solver::Constraints> constraints;

  bool operator==(const DrawnMarks&) const = default;
};

// How a label is painted in slices: under the mouse, or inside of its way, or of lines along edges between
// clicks. In 3D it is the brush always.
enum class LabelWay { brush, outline, livewire };

// Values of the source.
struct ValueRange {
  double low = 0.0;
  double high = 0.0;

  [[nodiscard]] bool contains(double value) const { return value >= low && value <= high; }
  bool operator==(const ValueRange&) const = default;
};

// What paints labels.
struct LabelBrush {
  std::uint8_t label = 0;  // 0, or one that is gone: the newest
  document::Take take = document::Take::free_voxels;
  LabelWay way = LabelWay::brush;
  std::optional<ValueRange> values;  // only voxels with these change

  bool operator==(const LabelBrush&) const = default;
};

class Display : public QObject {
  Q_OBJECT
 public:
  [[nodiscard]] const DisplaySettings& settings() const { return settings_; }
  // Changes some of the settings: display.change([&](DisplaySettings& s) { s.window = window; });
  template <class Change>
  void change(Change&& apply) {
    DisplaySettings next = settings_;
    apply(next);
    set(std::move(next));
  }
  void set(DisplaySettings next);  // emits changed() unless nothing is different
  void choose_tool(Tool tool);     // remembers the one before

  // The mouse's place in the patient (LPS, mm), from any view: brushes and values follow it in all views.
  [[nodiscard]] const std::optional<glm::dvec3>& pointer_mm() const { return pointer_mm_; }
  void set_pointer(std::optional<glm::dvec3> patient_mm);
  // The sphere that is drawn in one view is seen in all.
  [[nodiscard]] const std::optional<DrawnSphere>& drawn_sphere() const { return drawn_sphere_; }
  void set_drawn_sphere(std::optional<DrawnSphere> drawn);
  // So are marks.
  [[nodiscard]] const std::optional<DrawnMarks>& drawn_marks() const { return drawn_marks_; }
  void set_drawn_marks(std::optional<DrawnMarks> drawn);
  // So is a stroke over a label; null: none.
  [[nodiscard]] const std::shared_ptr<const LabelPreview>& drawn_label() const { return drawn_label_; }
  void set_drawn_label(std::shared_ptr<const LabelPreview> drawn);
  // It is not saved.
  [[nodiscard]] const LabelBrush& label_brush() const { return label_brush_; }
  void set_label_brush(const LabelBrush& brush) { label_brush_ = brush; }
  // The label that all tools for labels work on from now on.
  void choose_label(std::uint8_t label);
  // What the runs of a sweep agree on, over the slices and all images; it is not saved.
  [[nodiscard]] const std::optional<ShownImage>& agreement() const { return agreement_; }
  void set_agreement(std::optional<ShownImage> agreement);
  // The runs whose surfaces lie apart as the surface's colours tell; null: none. Nor is it saved.
  [[nodiscard]] const std::shared_ptr<const document::Agreement>& spread() const { return spread_; }
  void set_spread(std::shared_ptr<const document::Agreement> runs);

 signals:
  void changed();
  void pointer_moved();  // or what is being drawn has changed
  void label_chosen(std::uint8_t label);

 private:
  DisplaySettings settings_;
  std::optional<glm::dvec3> pointer_mm_;
  std::optional<DrawnSphere> drawn_sphere_;
  std::optional<DrawnMarks> drawn_marks_;
  std::shared_ptr<const LabelPreview> drawn_label_;
  LabelBrush label_brush_;
  std::optional<ShownImage> agreement_;
  std::shared_ptr<const document::Agreement> spread_;
};

}  // namespace tidemark::engine
