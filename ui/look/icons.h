// The pictures on buttons and in menus: drawings of one colour, which is the palette's.
#pragma once

#include <QIcon>
#include <QStringList>
#include <QStringView>

namespace tidemark::ui {

// resources/icons/NAME.svg in the palette's text colour at the moment of painting (enabled, disabled,
// selected), sharp at any size and scale. For an unknown name it returns a null icon and prints a
// warning.
QIcon icon(QStringView name);

// All names that icon() knows, sorted.
QStringList icon_names();

// Tidemark's own, in its colours: for windows and "About".
QIcon application_icon();

}  // namespace tidemark::ui
