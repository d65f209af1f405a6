// The outline of a mask, or of a level set, in a slice.
#pragma once

#include <QLineF>
#include <QList>

#include "core/bit_mask.h"
#include "engine/label_preview.h"
#include "renderer/camera.h"
#include "solver/field.h"

namespace tidemark::ui {

// Lines between the middles of neighbouring voxels that differ, in mm along the slice's right (x) and up (y)
// from the patient's origin. `position_mm`: a point of the slice (LPS).
QList<QLineF> outline_in_slice(const BitMask& mask, const renderer::SliceOrientation& orientation,
                               glm::dvec3 position_mm);

// Of each region that labels would become.
QList<QLineF> outline_in_slice(const engine::LabelPreview& preview,
                               const renderer::SliceOrientation& orientation, glm::dvec3 position_mm);

// Of phi = 0, between voxels by interpolation.
QList<QLineF> outline_in_slice(const solver::Field& phi, const renderer::SliceOrientation& orientation,
                               glm::dvec3 position_mm);

}  // namespace tidemark::ui
