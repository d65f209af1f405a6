#include "gpu/capabilities.h"

#include <fmt/format.h>

#include "gpu/gl.h"

namespace tidemark::gpu {
namespace {

std::string text(GLenum name) {
  const auto* value = reinterpret_cast<const char*>(glGetString(name));
  return value != nullptr ? value : "";
}

std::int64_t integer(GLenum name) {
  GLint64 value = 0;
  glGetInteger64v(name, &value);
  return value;
}

bool is_software(const std::string& renderer) {
  for (const char* name : {"llvmpipe", "softpipe", "swrast", "SWR", "Software Rasterizer"}) {
    if (renderer.find(name) != std::string::npos) return true;
  }
  return false;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> Capabilities::entries() const {
  return {{"vendor", vendor},
          {"renderer", renderer},
          {"version", version},
          {"opengl", fmt::format("{}.{}", major, minor)},
          {"software", software ? "yes" : "no"},
          {"reset_reported", reset_reported ? "yes" : "no"},
          {"largest_texture", fmt::to_string(largest_texture)},
          {"largest_layers", fmt::to_string(largest_layers)},
          {"largest_volume_texture", fmt::to_string(largest_volume_texture)},
          {"largest_buffer_texture", fmt::to_string(largest_buffer_texture)},
          {"largest_storage_buffer", fmt::to_string(largest_storage_buffer)},
          {"shared_memory", fmt::to_string(shared_memory)}};
}

Capabilities query_capabilities() {
  Capabilities c;
  c.vendor = text(GL_VENDOR);
  c.renderer = text(GL_RENDERER);
  c.version = text(GL_VERSION);
  c.major = static_cast<int>(integer(GL_MAJOR_VERSION));
  c.minor = static_cast<int>(integer(GL_MINOR_VERSION));
  c.software = is_software(c.renderer);
  c.largest_texture = integer(GL_MAX_TEXTURE_SIZE);
  c.largest_layers = integer(GL_MAX_ARRAY_TEXTURE_LAYERS);
  c.largest_volume_texture = integer(GL_MAX_3D_TEXTURE_SIZE);
  c.largest_buffer_texture = integer(GL_MAX_TEXTURE_BUFFER_SIZE);
  if (c.at_least(4, 3)) {
    c.largest_storage_buffer = integer(GL_MAX_SHADER_STORAGE_BLOCK_SIZE);
    c.shared_memory = integer(GL_MAX_COMPUTE_SHARED_MEMORY_SIZE);
  }
  // Before 4.5 device.cpp asks by a function of this extension.
  if (c.at_least(4, 5) || epoxy_has_gl_extension("GL_ARB_robustness")) {
    c.reset_reported = integer(GL_RESET_NOTIFICATION_STRATEGY) == GL_LOSE_CONTEXT_ON_RESET;
  }
  return c;
}

}  // namespace tidemark::gpu
