// The menu of a view: what menus and panels offer for it, at hand where the mouse is.
#pragma once

#include <glm/vec3.hpp>
#include <optional>

class QMenu;

namespace tidemark::ui {

class Actions;
class PictureView;

// Deletes itself when it closes. `place_mm` (LPS): what lies under the mouse; none: nothing of the patient.
QMenu* make_view_menu(PictureView& view, const Actions& actions, std::optional<glm::dvec3> place_mm);

}  // namespace tidemark::ui
