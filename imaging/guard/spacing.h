// The distances between voxels that can be anatomy; any other number is damage.
#pragma once

namespace tidemark::imaging {

// In mm; false for NaN.
constexpr bool is_sensible_spacing(double mm) {
  return mm >= 1e-5 && mm <= 1000.0;
}

}  // namespace tidemark::imaging
