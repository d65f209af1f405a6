// A question to OpenGL about the storage of a buffer.
#pragma once

#include "gpu/buffer.h"

namespace tidemark::test {

// Whether the storage is immutable and can be mapped by nobody.
bool cannot_be_mapped(const gpu::Buffer& buffer);

}  // namespace tidemark::test
