// The picture of a case for its review: three slices through the middle of the result, and its surface.
#pragma once

#include "core/volume.h"
#include "renderer/picture.h"
#include "solver/field.h"

namespace tidemark::cohort {

// An axial, a coronal and a sagittal slice with the outline, and the whole surface from in front and a little
// from the left and above: squares beside each other, `side` pixels high. Drawn by the processor, with the
// same pixels for any number of threads. Fails as HostRenderer::create() does.
[[nodiscard]] Result<renderer::Picture> case_picture(const Volume& source, const solver::Field& phi,
                                                     std::int64_t side, int threads);

}  // namespace tidemark::cohort
