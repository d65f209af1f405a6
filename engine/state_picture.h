// Small pictures of a level set in its study, to know a state of a case by.
#pragma once

#include <QImage>

#include "solver/field.h"

namespace tidemark::engine {

// The slice along k that has most voxels inside, around the surface, with its outline. At most `pixels` wide
// and high; as radiologists look at it. phi must be on the volume's grid. Null where nothing is inside.
QImage picture_of_state(const Volume& volume, const solver::Field& phi, const WindowLevel& window,
                        int pixels);

}  // namespace tidemark::engine
