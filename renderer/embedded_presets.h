// The presets as of the program's build. Private to this folder; the .cpp is generated.
#pragma once

#include <span>
#include <string_view>

namespace tidemark::renderer {

struct EmbeddedPreset {
  std::string_view name;
  std::string_view text;
};

std::span<const EmbeddedPreset> embedded_presets();

}  // namespace tidemark::renderer
