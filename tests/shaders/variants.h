// The variants of the shaders that the program asks for, found by asking for them.
#pragma once

#include <vector>

#include "gpu/shader_source.h"

namespace tidemark::test {

// What the executors and the benchmark compile, for every source, scheme, grid, speed function, constraint,
// page and kind of driver.
std::vector<gpu::ProgramSource> solver_variants();

// What the renderer compiles for views that differ in up to two choices from a plain one, or in one from a
// rich one.
std::vector<gpu::ProgramSource> renderer_variants();

}  // namespace tidemark::test
