// A CT of a chest as numbers alone: body, lungs with vessels, spine and ribs, and the table under it all.
#pragma once

#include "core/volume.h"

namespace tidemark::bench {

// Values in HU with noise of 12 HU. The sizes of the parts follow `size`, the voxels are 0.75 x 0.75 x 1 mm.
Volume ct_phantom(Index3 size);

}  // namespace tidemark::bench
