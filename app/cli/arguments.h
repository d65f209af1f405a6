// Numbers on the command line: read the same way in every locale, and always finite.
#pragma once

#include <CLI/App.hpp>
#include <cstdint>
#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/geometry.h"
#include "core/result.h"
#include "solver/sphere.h"

namespace tidemark::cli {

inline constexpr std::int64_t kMebibyte = std::int64_t{1} << 20;

// A finite decimal number, nothing before or after it. Fails with ErrorKind::usage.
Result<double> parse_number(std::string_view text);
Result<std::int64_t> parse_count(std::string_view text);  // a whole number >= 0

// Exactly `count` finite numbers, separated by commas.
Result<std::vector<double>> parse_numbers(std::string_view text, std::size_t count);

// Options that hold such numbers. Errors name the option and end in wrong usage.
CLI::Option* add_number(CLI::App& app, const std::string& name, std::optional<double>& value,
                        const std::string& description);
CLI::Option* add_count(CLI::App& app, const std::string& name, std::optional<std::int64_t>& value,
                       const std::string& description);
CLI::Option* add_numbers(CLI::App& app, const std::string& name, const std::string& shape,
                         std::optional<std::vector<double>>& values, const std::string& description);

// An option of a few words.
template <class Value>
CLI::Option* add_choice(CLI::App& app, const std::string& name, Value& value,
                        const std::map<std::string, Value>& words, const std::string& description) {
  std::string type;
  for (const auto& [word, meaning] : words) type += (type.empty() ? "" : "|") + word;
  const auto store = [name, type, words, &value](const std::string& word) {
    const auto found = words.find(word);
    if (found == words.end()) throw CLI::ValidationError(name, "'" + word + "' is not one of " + type);
    value = found->second;
  };
  return app.add_option_function<std::string>(name, store, description)->type_name(type);
}

// A seed or eraser as given on the command line.
struct SphereArgument {
  std::string option;  // "--seed 10,20,30,5", for messages
  glm::dvec3 centre{0.0};
  bool in_voxels = true;  // centre: voxel indices (fractions allowed), else patient LPS mm
  double radius_mm = 0.0;

  // The sphere in the patient. Fails (ErrorKind::usage) naming the option and the volume's size when the
  // centre is outside the volume.
  [[nodiscard]] Result<solver::Sphere> resolve(const Geometry& geometry) const;
};

enum class SphereUnits { voxels, millimetres };

// An option that may be repeated, four numbers each time: I,J,K,R or X,Y,Z,R.
CLI::Option* add_spheres(CLI::App& app, const std::string& name, SphereUnits units,
                         std::vector<SphereArgument>& spheres, const std::string& description);

}  // namespace tidemark::cli
