// Transfer functions: the look of the source's values and of places on the surface (paper section 6.2).
#pragma once

#include <filesystem>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"

namespace tidemark::renderer {

// A factor of a primitive's opacity, along one axis.
struct TransferFactor {
  enum class Kind { everything, gaussian, ramp };
  Kind kind = Kind::everything;
  double start = 0.0;  // Gaussian: its centre; ramp: where it begins
  double end = 1.0;    // Gaussian: its width (1/e); ramp: where it is 1

  bool operator==(const TransferFactor&) const = default;
  [[nodiscard]] double at(double x) const;
  // The greatest factor in [low, high].
  [[nodiscard]] double most(double low, double high) const;
};

// Of the source: opacity is that of a mm where all factors are 1.
struct SourcePrimitive {
  TransferFactor value;     // the source's units
  TransferFactor gradient;  // its magnitude, source units a mm
  TransferFactor phi;       // smallest voxel spacings, > 0 inside
  double opacity = 1.0;
  glm::vec3 colour{1.0F};

  bool operator==(const SourcePrimitive&) const = default;
};

// Of the surface.
struct SurfacePrimitive {
  TransferFactor intensity;  // the source's units
  TransferFactor distance;   // from the clip plane, mm; 0 without one
  double opacity = 1.0;
  glm::vec3 colour{1.0F};

  bool operator==(const SurfacePrimitive&) const = default;
};

// Sums of primitives; colours are mixed by opacity. A surface without primitives has the view's colour.
struct TransferFunction {
  static constexpr std::size_t kMostPrimitives = 16;  // of each list, as in render/transfer.glsl

  std::string name;
  // Values, intensities and gradients are shares of the source's common range (Volume::common_range(): 0 its
  // low end, 1 its high end), for modalities whose values have no unit.
  bool relative = false;
  std::vector<SourcePrimitive> source;
  std::vector<SurfacePrimitive> surface;

  bool operator==(const TransferFunction&) const = default;
  // The same in a source's own units, whose common range is [low, high].
  [[nodiscard]] TransferFunction for_range(double low, double high) const;
  [[nodiscard]] bool source_needs_gradient() const;
  [[nodiscard]] bool source_needs_phi() const;
  // The greatest opacity (of a mm) of any value and phi in these ranges.
  [[nodiscard]] double most_opacity(double low, double high, double low_phi, double high_phi) const;

  // Reads what a preset file holds:
  //   {"name": "...", "relative": true (else the source's units), "source": [PRIMITIVE with "value",
  //   "gradient", "phi"], "surface": [PRIMITIVE with "intensity", "distance"]}, a primitive having "opacity"
  //   and "colour": [r, g, b] (0 to 1), and for each axis that matters {"gaussian": [centre, width]} or
  //   {"ramp": [start, end]}.
  // Fails (ErrorKind::input) and names the field.
  // `file` is for messages.
  static Result<TransferFunction> parse(std::string_view json, const std::string& file = "preset");
  static Result<TransferFunction> load(const std::filesystem::path& file);
  // JSON that parse() reads back as the same function, if it keeps to the limits of parse().
  [[nodiscard]] std::string to_json() const;
};

// The presets that the program brings, by the name of their file without ".json".
std::vector<std::string> preset_names();
Result<TransferFunction> preset(std::string_view name);

}  // namespace tidemark::renderer
