#include "engine/display.h"

namespace tidemark::engine {

bool has_right_button(Tool tool) {
  return tool == Tool::seed || tool == Tool::paint || tool == Tool::erase || tool == Tool::examples ||
         tool == Tool::wall || tool == Tool::label;
}

void Display::set(DisplaySettings next) {
  if (next == settings_) return;
  settings_ = std::move(next);
  emit changed();
}

void Display::choose_label(std::uint8_t label) {
  label_brush_.label = label;
  emit label_chosen(label);
}

void Display::choose_tool(Tool tool) {
  change([&](DisplaySettings& settings) {
    if (settings.tool == tool) return;
    settings.last_tool = settings.tool;
    settings.tool = tool;
  });
}

void Display::set_pointer(std::optional<glm::dvec3> patient_mm) {
  if (patient_mm == pointer_mm_) return;
  pointer_mm_ = patient_mm;
  emit pointer_moved();
}

void Display::set_drawn_sphere(std::optional<DrawnSphere> drawn) {
  if (drawn == drawn_sphere_) return;
  drawn_sphere_ = drawn;
  emit pointer_moved();
}

void Display::set_drawn_marks(std::optional<DrawnMarks> drawn) {
  if (drawn == drawn_marks_) return;
  drawn_marks_ = std::move(drawn);
  emit pointer_moved();
}

void Display::set_drawn_label(std::shared_ptr<const LabelPreview> drawn) {
  if (drawn == drawn_label_) return;
  drawn_label_ = std::move(drawn);
  emit pointer_moved();
}

void Display::set_agreement(std::optional<ShownImage> agreement) {
  if (agreement_ == agreement) return;
  agreement_ = std::move(agreement);
  emit changed();
}

void Display::set_spread(std::shared_ptr<const document::Agreement> runs) {
  if (spread_ == runs) return;
  spread_ = std::move(runs);
  emit changed();
}

}  // namespace tidemark::engine
