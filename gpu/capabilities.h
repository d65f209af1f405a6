// The capabilities of the machine's OpenGL.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace tidemark::gpu {

struct Capabilities {
  std::string vendor;
  std::string renderer;
  std::string version;
  int major = 0;
  int minor = 0;
  bool software = false;                    // the processor plays the GPU (llvmpipe, softpipe, swrast)
  bool reset_reported = false;              // a lost context is reported
  std::int64_t largest_texture = 0;         // texels along an axis, 2D
  std::int64_t largest_layers = 0;          // of a texture that has some
  std::int64_t largest_volume_texture = 0;  // voxels along an axis, 3D
  std::int64_t largest_buffer_texture = 0;  // texels
  std::int64_t largest_storage_buffer = 0;  // bytes; 0 before OpenGL 4.3
  std::int64_t shared_memory = 0;           // bytes a work group; 0 before OpenGL 4.3

  [[nodiscard]] bool at_least(int wanted_major, int wanted_minor) const {
    return major > wanted_major || (major == wanted_major && minor >= wanted_minor);
  }

  // Every member by name, to be printed.
  [[nodiscard]] std::vector<std::pair<std::string, std::string>> entries() const;
};

// Those of the context that is current.
Capabilities query_capabilities();

}  // namespace tidemark::gpu
