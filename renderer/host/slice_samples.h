// The source at the pixels of a slice's tile, in lanes.
#pragma once

#include "renderer/host/slice_tile.h"

namespace tidemark::renderer {

// Fills tile.source, trilinearly or with the nearest voxel's value.
void sample_source(const SourceSamples& samples, bool nearest, SliceTile& tile);

}  // namespace tidemark::renderer
