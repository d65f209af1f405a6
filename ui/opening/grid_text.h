// Grids as text for people.
#pragma once

#include <QString>

#include "core/geometry.h"

namespace tidemark::ui {

QString size_text(const Geometry& geometry);     // "256 × 256 × 100"
QString spacing_text(const Geometry& geometry);  // "1.02 × 1.02 × 2.5", in the user's locale
QString grid_text(const Geometry& geometry);     // "256 × 256 × 100 voxels of 1.02 × 1.02 × 2.5 mm"

}  // namespace tidemark::ui
