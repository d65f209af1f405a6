// How the source's values show: a sum of Gaussians and ramps, evaluated in the shader.
#pragma once

#include <filesystem>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"

namespace tidemark {

struct TransferPrimitive {
  enum class Kind { gaussian, ramp };
  Kind kind = Kind::gaussian;
  double start = 0.0;    // Gaussian: its centre; ramp: where it begins. In the source's units.
  double end = 1.0;      // Gaussian: its width (1/e); ramp: where it is full
  double opacity = 1.0;  // at the peak, of a millimetre
  glm::vec3 colour{1.0F};
};

struct TransferFunction {
  static constexpr std::size_t kMostPrimitives = 16;

  std::string name;
  std::vector<TransferPrimitive> source;

  // Reads what a preset file holds: {"name", "source": [{"kind": "gaussian", "centre", "width", "opacity",
  // "colour": [r, g, b]} or {"kind": "ramp", "start", "end", "opacity", "colour"}]}. Fails (ErrorKind::input)
  // and names the field.
  static Result<TransferFunction> parse(std::string_view json);
  static Result<TransferFunction> load(const std::filesystem::path& file);
};

// The presets that the program brings, by the name of their file without ".json".
std::vector<std::string> preset_names();
Result<TransferFunction> preset(std::string_view name);

}  // namespace tidemark
