#include "engine/display_json.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "core/json/json.h"
#include "core/json/json_field.h"
#include "document/file_limits.h"

namespace tidemark::engine {
namespace {

constexpr double kMostSkew = 1e-3;  // of two unit vectors: the cosine of the angle between them
constexpr std::int64_t kMostStrokeSteps = 1'000'000;
constexpr JsonLimits kLimits{.bytes = std::size_t{16} << 20, .values = std::size_t{1} << 20};

Json json_of(glm::dvec3 v) {
  return {v.x, v.y, v.z};
}

template <class Enum>
void read_enum(const JsonField& parent, const char* key, int count, Enum& value) {
  if (parent.has(key)) value = static_cast<Enum>(parent.at(key).integer(0, count - 1));
}
void read(const JsonField& parent, const char* key, bool& value) {
  if (parent.has(key)) value = parent.at(key).boolean();
}
void read(const JsonField& parent, const char* key, double low, double high, double& value) {
  if (parent.has(key)) value = parent.at(key).number(low, high);
}
void read(const JsonField& parent, const char* key, glm::dvec3& value) {
  if (parent.has(key)) value = parent.at(key).vector(-document::kFarthest_mm, document::kFarthest_mm);
}
void read_unit(const JsonField& parent, const char* key, glm::dvec3& value) {
  if (!parent.has(key)) return;
  const glm::dvec3 read = parent.at(key).vector(-1.0, 1.0);
  if (glm::length(read) < 0.5) return parent.at(key).wrong("is not a direction");
  value = glm::normalize(read);
}
// Numbers of few digits are nearly at right angles, and are brought there.
void read_plane(const JsonField& parent, renderer::SliceOrientation& plane) {
  read_unit(parent, "oblique_right", plane.right);
  read_unit(parent, "oblique_up", plane.up);
  const double skew = glm::dot(plane.right, plane.up);
  if (std::abs(skew) > kMostSkew)
    return parent.at("oblique_up").wrong("is not at right angles to oblique_right");
  if (skew != 0.0) plane.up = glm::normalize(plane.up - plane.right * skew);
}
// Volumes of floats have any values.
void read_window(const JsonField& parent, WindowLevel& window) {
  using Limits = std::numeric_limits<double>;
  read(parent, "window_centre", Limits::lowest(), Limits::max(), window.centre);
  read(parent, "window_width", Limits::min(), Limits::max(), window.width);
}

Json slices_json(const DisplaySettings& s) {
  return {{"cursor_mm", json_of(s.cursor_mm)},
          {"centre_mm", json_of(s.slice_centre_mm)},
          {"zoom", s.slice_zoom},
          {"oblique_right", json_of(s.oblique.right)},
          {"oblique_up", json_of(s.oblique.up)},
          {"window_centre", s.window.centre},
          {"window_width", s.window.width},
          {"nearest", s.nearest},
          {"outline", s.outline},
          {"contours", s.contours},
          {"line_pixels", s.line_pixels},
          {"label_opacity", s.label_opacity},
          {"crosshair", s.crosshair},
          {"truth", s.truth},
          {"truth_error", s.truth_error},
          {"forces", s.forces},
          {"marks", s.marks},
          {"change", s.change},
          {"speed_term", static_cast<int>(s.speed_term)},
          {"radiological", s.radiological},
          {"patient_text", s.patient_text},
          {"swipe", s.swipe},
          {"swipe_at", s.swipe_at}};
}

void read_slices(const JsonField& field, DisplaySettings& s) {
  read(field, "cursor_mm", s.cursor_mm);
  read(field, "centre_mm", s.slice_centre_mm);
  read(field, "zoom", 0.01, 1000.0, s.slice_zoom);
  read_plane(field, s.oblique);
  read_window(field, s.window);
  read(field, "nearest", s.nearest);
  read(field, "outline", s.outline);
  read(field, "contours", s.contours);
  read(field, "line_pixels", 0.1, 20.0, s.line_pixels);
  read(field, "label_opacity", 0.0, 1.0, s.label_opacity);
  read(field, "crosshair", s.crosshair);
  read(field, "truth", s.truth);
  read(field, "truth_error", s.truth_error);
  read(field, "forces", s.forces);
  read(field, "marks", s.marks);
  read(field, "change", s.change);
  read_enum(field, "speed_term", 5, s.speed_term);
  read(field, "radiological", s.radiological);
  read(field, "patient_text", s.patient_text);
  read(field, "swipe", s.swipe);
  read(field, "swipe_at", 0.0, 1.0, s.swipe_at);
}

Json volume_json(const DisplaySettings& s) {
  Json json{
      {"azimuth", s.camera.azimuth},
      {"elevation", s.camera.elevation},
      {"zoom", s.camera.zoom},
      {"mode", static_cast<int>(s.mode)},
      {"surface", s.surface},
      {"surface_colour", {s.surface_colour.r, s.surface_colour.g, s.surface_colour.b, s.surface_colour.a}},
      {"colouring", static_cast<int>(s.colouring)},
      {"show_source", s.show_source},
      {"region", static_cast<int>(s.region)},
      {"occlusion", s.occlusion},
      {"orientation_cube", s.orientation_cube},
      {"volume_box", s.volume_box},
      {"clip_on", s.clip_on},
      {"clip_normal", json_of(s.clip.normal)},
      {"clip_offset_mm", s.clip.offset_mm},
      {"clips_source", s.clip.clips_source},
      {"clips_surface", s.clip.clips_surface},
      {"clip_picture", s.clip.picture}};
  const bool transfers = !s.transfer.source.empty() || !s.transfer.surface.empty();
  if (transfers) json["transfer"] = s.transfer.to_json();
  if (s.camera.focus_mm) json["focus_mm"] = json_of(*s.camera.focus_mm);
  return json;
}

void read_volume(const JsonField& field, DisplaySettings& s) {
  read(field, "azimuth", -360.0, 360.0, s.camera.azimuth);
  read(field, "elevation", -90.0, 90.0, s.camera.elevation);
  read(field, "zoom", 0.01, 1000.0, s.camera.zoom);
  if (field.has("focus_mm")) read(field, "focus_mm", s.camera.focus_mm.emplace());
  read_enum(field, "mode", 2, s.mode);
  read(field, "surface", s.surface);
  if (field.has("surface_colour")) {
    const JsonField colour = field.at("surface_colour");
    for (std::size_t i = 0; i < 4; ++i) {
      s.surface_colour[static_cast<int>(i)] = static_cast<float>(colour.at(i).number(0.0, 1.0));
    }
  }
  read_enum(field, "colouring", 7, s.colouring);
  read(field, "show_source", s.show_source);
  s.transfer = {};
  if (field.has("transfer")) {
    auto transfer = renderer::TransferFunction::parse(field.at("transfer").text(std::size_t{1} << 20U));
    if (transfer) {
      s.transfer = std::move(*transfer);
    } else {
      field.at("transfer").wrong(transfer.error().message);
    }
  }
  read_enum(field, "region", 4, s.region);
  read(field, "occlusion", 0.0, 1.0, s.occlusion);
  read(field, "orientation_cube", s.orientation_cube);
  read(field, "volume_box", s.volume_box);
  read(field, "clip_on", s.clip_on);
  read_unit(field, "clip_normal", s.clip.normal);
  read(field, "clip_offset_mm", -document::kFarthest_mm, document::kFarthest_mm, s.clip.offset_mm);
  read(field, "clips_source", s.clip.clips_source);
  read(field, "clips_surface", s.clip.clips_surface);
  read(field, "clip_picture", s.clip.picture);
}

Json json_of(const Measurement& measurement) {
  Json points = Json::array();
  for (const glm::dvec3& point : measurement.points_mm) points.push_back(json_of(point));
  return {{"kind", measurement.kind == Measurement::Kind::distance ? "distance" : "angle"},
          {"points_mm", points}};
}

Json measurements_json(const DisplaySettings& s) {
  Json list = Json::array();
  for (const Measurement& measurement : s.measurements) list.push_back(json_of(measurement));
  return list;
}

// How each image is shown; the images themselves are no part of it.
Json images_json(const DisplaySettings& s) {
  Json list = Json::array();
  for (const ShownImage& shown : s.images) {
    list.push_back({{"visible", shown.visible},
                    {"colours", static_cast<int>(shown.colours)},
                    {"opacity", shown.opacity},
                    {"window_centre", shown.window.centre},
                    {"window_width", shown.window.width},
                    {"used", shown.used}});
  }
  return list;
}

void read_images(const JsonField& field, DisplaySettings& s) {
  const std::size_t count = std::min(field.size(document::kMostImages), s.images.size());
  for (std::size_t i = 0; i < count; ++i) {
    const JsonField one = field.at(i);
    ShownImage& shown = s.images[i];
    read(one, "visible", shown.visible);
    read_enum(one, "colours", 4, shown.colours);
    read(one, "opacity", 0.0, 1.0, shown.opacity);
    read_window(one, shown.window);
    read(one, "used", shown.used);
  }
}

Measurement read_measurement(const JsonField& field) {
  Measurement measurement;
  measurement.kind = field.at("kind").word({"distance", "angle"}) == 0 ? Measurement::Kind::distance
                                                                       : Measurement::Kind::angle;
  const JsonField points = field.at("points_mm");
  for (std::size_t p = 0; p < points.size(3); ++p) {
    measurement.points_mm.push_back(points.at(p).vector(-document::kFarthest_mm, document::kFarthest_mm));
  }
  return measurement;
}

// With the line of a profile.
void read_measurements(const JsonField& root, DisplaySettings& s) {
  constexpr std::size_t kMost = 1000;
  if (root.has("measurements")) {
    const JsonField list = root.at("measurements");
    s.measurements.clear();
    for (std::size_t i = 0; i < list.size(kMost); ++i) {
      Measurement measurement = read_measurement(list.at(i));
      if (measurement.complete()) s.measurements.push_back(std::move(measurement));
    }
  }
  if (root.has("profile")) {
    Measurement line = read_measurement(root.at("profile"));
    if (line.kind != Measurement::Kind::distance || !line.complete())
      return root.at("profile").wrong("is not a line");
    s.profile = std::move(line);
  }
}

}  // namespace

std::string to_json(const DisplaySettings& s) {
  Json json{{"slices", slices_json(s)},
            {"volume", volume_json(s)},
            {"tool", static_cast<int>(s.tool)},
            {"brush_mm", s.brush_mm},
            {"stroke_voxels", s.stroke_voxels},
            {"stroke_steps", s.stroke_steps},
            {"wall_behind_eraser", s.wall_behind_eraser},
            {"chosen_primitive", s.chosen_primitive},
            {"images", images_json(s)},
            {"measurements", measurements_json(s)}};
  if (s.profile) json["profile"] = json_of(*s.profile);
  return json.dump();
}

Result<DisplaySettings> display_settings(const std::string& text, DisplaySettings s) {
  const auto json = JsonDocument::parse(text, "view state", kLimits);
  if (!json) return pass_on(json);
  const JsonField root = root_of(*json, "view state");
  if (root.has("slices")) read_slices(root.at("slices"), s);
  if (root.has("volume")) read_volume(root.at("volume"), s);
  read_enum(root, "tool", kTools, s.tool);
  // The first one goes by the volume's size, whatever that is.
  if (root.has("brush_mm")) s.brush_mm = std::clamp(root.at("brush_mm").number(), 0.01, 1000.0);
  read(root, "stroke_voxels", 0.5, 100.0, s.stroke_voxels);
  if (root.has("stroke_steps")) s.stroke_steps = root.at("stroke_steps").integer(0, kMostStrokeSteps);
  read(root, "wall_behind_eraser", s.wall_behind_eraser);
  if (root.has("chosen_primitive"))
    s.chosen_primitive = static_cast<int>(root.at("chosen_primitive").integer(0, 1000));
  if (root.has("images")) read_images(root.at("images"), s);
  read_measurements(root, s);
  if (!root.good()) return pass_on(root.status());
  return s;
}

Result<DisplaySettings> display_measurements(const std::string& text, DisplaySettings s) {
  const auto json = JsonDocument::parse(text, "view state", kLimits);
  if (!json) return pass_on(json);
  const JsonField root = root_of(*json, "view state");
  read_measurements(root, s);
  if (!root.good()) return pass_on(root.status());
  return s;
}

}  // namespace tidemark::engine
