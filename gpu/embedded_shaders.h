// The shader files as of the program's build. Private to this folder; the .cpp is generated.
#pragma once

#include <span>
#include <string_view>

namespace tidemark::gpu {

struct EmbeddedShader {
  std::string_view path;  // below resources/shaders
  std::string_view text;
};

std::span<const EmbeddedShader> embedded_shaders();

}  // namespace tidemark::gpu
