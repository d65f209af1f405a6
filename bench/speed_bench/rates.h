// Rates of speed functions, in voxels a second.
#pragma once

#include "studies.h"

namespace tidemark {

// Prints a line a function: pages at a surface, one by one as executors ask, and slices as views do, by one
// thread; and pages by one thread a processor.
Status measure_rates(const engine::LoadedStudy& study);

}  // namespace tidemark
