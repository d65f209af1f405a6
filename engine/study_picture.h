// Small pictures of slices, to know a study by.
#pragma once

#include <QImage>

#include "core/volume.h"

namespace tidemark::engine {

// The first slice of a volume, at most `pixels` wide and high. Axial, coronal and sagittal slices lie as
// radiologists look at them; pixels are square in mm. Null where there is nothing to show.
QImage picture_of_slice(const Volume& slice, const WindowLevel& window, int pixels);

// The same of a slice of the volume by its index along k, as it lies in memory.
QImage picture_of_volume(const Volume& volume, const WindowLevel& window, std::int64_t k, int pixels);

}  // namespace tidemark::engine
