// The meaning of the left button in slices while no other tool than window and level is chosen.
#pragma once

namespace tidemark::ui {

enum class MouseScheme {
  tidemark,  // window and level
  itk_snap,  // moves the crosshair
};

// As the user has set it; kept in the settings.
[[nodiscard]] MouseScheme mouse_scheme();
void set_mouse_scheme(MouseScheme scheme);

}  // namespace tidemark::ui
