// The picture of a case for its review: three slices through the middle of the result, with its outline.
#pragma once

#include <cstdint>
#include <vector>

#include "core/volume.h"

namespace tidemark::cohort {

// Red, green, blue and opacity (255), rows from the top.
struct CasePicture {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> pixels;
};

// One square each across k, j and i beside each other, `side` pixels high, in the file's window or over the
// values that are common. Rows and columns run as the patient's right, front and head do: to the left and
// above. The slices go through the middle of the inside, and show the volume as a whole.
[[nodiscard]] CasePicture case_picture(const Volume& source, const Mask& mask, int side);

}  // namespace tidemark::cohort
