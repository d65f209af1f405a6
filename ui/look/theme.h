// Colours, distances and the style of the desktop.
#pragma once

#include <QPalette>

class QApplication;

namespace tidemark::ui {

// `system` is light or dark, whichever is nearer to the platform's palette at the program's start.
enum class Theme { system, light, dark };

// May be called while the program runs; all widgets are painted anew.
void apply_theme(QApplication& application, Theme theme);

// Dark: greys without a tint, darker than the tissue in an image. Light: for bright rooms and projectors.
// Texts have a contrast of at least 4.5 to their background, disabled ones at least 3.
QPalette light_palette();
QPalette dark_palette();
bool is_dark(const QPalette& palette);

// Of a frame around what cannot be taken as it is; on fields it has a contrast of at least 4.5.
QColor problem_colour(const QPalette& palette);

// The colour of an open case's mark, by its number from 1 on; colours repeat after six. Colour-blind eyes
// tell them apart too (Okabe and Ito, "Color Universal Design"), and none is the surface's yellow.
QColor case_colour(int number);

// Distances of layouts, in pixels of the unscaled screen.
inline constexpr int kSpaceTight = 4;    // between parts of one control
inline constexpr int kSpace = 8;         // between controls, and from a panel's edge
inline constexpr int kSpaceGroups = 16;  // between groups, and from a dialog's edge

// Sides of icons.
inline constexpr int kIconSmall = 16;  // in menus, lists and views
inline constexpr int kIcon = 20;       // on tool bars

}  // namespace tidemark::ui
