#include "gpu/label.h"

#include "gpu/gl.h"

namespace tidemark::gpu {

void set_label(const Device& device, unsigned kind, unsigned id, std::string_view label) {
  if (device.debugging()) glObjectLabel(kind, id, static_cast<GLsizei>(label.size()), label.data());
}

}  // namespace tidemark::gpu
