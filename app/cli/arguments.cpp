#include "app/cli/arguments.h"

#include <algorithm>

#include "core/number_from.h"

namespace tidemark::cli {
namespace {

// Hands a parsed value to `store`, or an error with the option's name to the parser.
template <class Parsed, class Store>
void take(const std::string& name, Result<Parsed> parsed, Store store) {
  if (!parsed) throw CLI::ValidationError(name, parsed.error().message);
  store(std::move(*parsed));
}

}  // namespace

Result<double> parse_number(std::string_view text) {
  const auto number = number_from<double>(text);
  if (!number) return fail(ErrorKind::usage, "'{}' is not a finite number", text);
  return *number;
}

Result<std::int64_t> parse_count(std::string_view text) {
  const auto number = number_from<std::int64_t>(text);
  if (!number || *number < 0) return fail(ErrorKind::usage, "'{}' is not a whole number >= 0", text);
  return *number;
}

Result<std::vector<double>> parse_numbers(std::string_view text, std::size_t count) {
  std::vector<double> numbers;
  const std::string_view whole = text;
  for (bool more = true; more;) {
    const std::size_t comma = text.find(',');
    auto number = parse_number(text.substr(0, comma));
    if (!number) return fail(ErrorKind::usage, "{}: {}", whole, number.error().message);
    numbers.push_back(*number);
    more = comma != std::string_view::npos;
    if (more) text.remove_prefix(comma + 1);
  }
  if (numbers.size() != count) {
    return fail(ErrorKind::usage, "{}: {} numbers separated by commas are needed, not {}", whole, count,
                numbers.size());
  }
  return numbers;
}

CLI::Option* add_number(CLI::App& app, const std::string& name, std::optional<double>& value,
                        const std::string& description) {
  const auto store = [name, &value](const std::string& text) {
    take(name, parse_number(text), [&](double number) { value = number; });
  };
  return app.add_option_function<std::string>(name, store, description)->type_name("NUMBER");
}

CLI::Option* add_count(CLI::App& app, const std::string& name, std::optional<std::int64_t>& value,
                       const std::string& description) {
  const auto store = [name, &value](const std::string& text) {
    take(name, parse_count(text), [&](std::int64_t number) { value = number; });
  };
  return app.add_option_function<std::string>(name, store, description)->type_name("N");
}

CLI::Option* add_numbers(CLI::App& app, const std::string& name, const std::string& shape,
                         std::optional<std::vector<double>>& values, const std::string& description) {
  const auto count = static_cast<std::size_t>(std::count(shape.begin(), shape.end(), ',')) + 1;
  const auto store = [name, count, &values](const std::string& text) {
    take(name, parse_numbers(text, count), [&](std::vector<double> numbers) { values = std::move(numbers); });
  };
  return app.add_option_function<std::string>(name, store, description)->type_name(shape);
}

CLI::Option* add_spheres(CLI::App& app, const std::string& name, SphereUnits units,
                         std::vector<SphereArgument>& spheres, const std::string& description) {
  const bool in_voxels = units == SphereUnits::voxels;
  const auto store_one = [name, in_voxels, &spheres](const std::string& text) {
    take(name, parse_numbers(text, 4), [&](const std::vector<double>& n) {
      if (n[3] <= 0.0) throw CLI::ValidationError(name, text + ": the radius must be greater than 0 mm");
      spheres.push_back({name + " " + text, {n[0], n[1], n[2]}, in_voxels, n[3]});
    });
  };
  const auto store = [store_one](const std::vector<std::string>& texts) {
    for (const std::string& text : texts) store_one(text);
  };
  return app.add_option_function<std::vector<std::string>>(name, store, description)
      ->allow_extra_args(false)
      ->type_name(in_voxels ? "I,J,K,R" : "X,Y,Z,R");
}

Result<solver::Sphere> SphereArgument::resolve(const Geometry& geometry) const {
  const solver::Sphere sphere{in_voxels ? geometry.to_patient(centre) : centre, radius_mm};
  if (geometry.covers(sphere.centre_mm)) return sphere;
  const glm::dvec3 voxel = in_voxels ? centre : geometry.to_voxel(centre);
  return fail(ErrorKind::usage,
              "{}: the centre, voxel ({:.6g}, {:.6g}, {:.6g}), is outside the volume of {} x {} x {} voxels",
              option, voxel.x, voxel.y, voxel.z, geometry.size.x, geometry.size.y, geometry.size.z);
}

}  // namespace tidemark::cli
