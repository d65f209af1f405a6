#include "app/cli/drive_options.h"

#include <algorithm>
#include <cmath>

#include "app/cli/arguments.h"
#include "imaging/load_study.h"
#include "imaging/onto_grid.h"
#include "solver/distance_transform.h"
#include "solver/speed/speed_registry.h"

namespace tidemark::cli {
namespace {

const char* const kSpeedGroup = "Speed";

// "tent|regions|edges"
std::string function_names() {
  std::string names;
  for (const solver::SpeedKind& kind : solver::speed_kinds())
    names += (names.empty() ? "" : "|") + std::string(kind.name);
  return names;
}

// "0 to 10 mm, default 1", or "least, most; default least"
std::string values_of(const solver::SpeedParameter& number) {
  if (number.choices.empty()) {
    return fmt::format("{:g} to {:g}{}{}, default {:g}", number.low, number.high,
                       *number.unit == '\0' ? "" : " ", number.unit, number.initial);
  }
  std::string words;
  for (const solver::SpeedChoice& choice : number.choices)
    words += (words.empty() ? "" : ", ") + std::string(choice.name);
  const auto initial = static_cast<std::size_t>(number.initial - number.low);
  return fmt::format("{}; default {}", words, number.choices[initial].name);
}

// "edges.sigma (0 to 10 mm, default 1): ..."
std::string values_help() {
  std::string text = "A number of a speed function; may be repeated:";
  for (const solver::SpeedKind& kind : solver::speed_kinds()) {
    for (const solver::SpeedParameter& number : kind.parameters) {
      text += fmt::format("\n{}.{} ({}): {}", kind.name, number.name, values_of(number), number.text);
    }
  }
  return text;
}

// One of the parameter's words, or a number.
Result<double> parse_value(const std::string& function, const std::string& name, const std::string& text) {
  if (const solver::SpeedKind* kind = solver::speed_kind(function)) {
    for (const solver::SpeedParameter& number : kind->parameters) {
      if (number.name != name || number.choices.empty()) continue;
      for (std::size_t i = 0; i < number.choices.size(); ++i) {
        if (text == number.choices[i].name) return number.low + static_cast<double>(i);
      }
      if (!parse_number(text))
        return fail(ErrorKind::usage, "'{}' is not one of {}", text, values_of(number));
    }
  }
  return parse_number(text);
}

bool uses(const DriveOptions& options, const char* function) {
  return std::find(options.functions.begin(), options.functions.end(), function) != options.functions.end();
}

Result<solver::SpeedSetting> setting_of(const DriveOptions& options) {
  solver::SpeedSetting setting;
  setting.combine = options.combine.value_or(setting.combine);
  if (!options.functions.empty()) setting.terms.clear();
  for (const std::string& function : options.functions) setting.terms.push_back({function, {}});
  for (const std::string& text : options.values) {
    const std::size_t dot = text.find('.');
    const std::size_t equal = text.find('=');
    if (dot == std::string::npos || equal == std::string::npos || equal < dot) {
      return fail(ErrorKind::usage, "--speed-value {}: FUNCTION.NAME=NUMBER is needed", text);
    }
    const std::string function = text.substr(0, dot);
    const std::string name = text.substr(dot + 1, equal - dot - 1);
    const auto number = parse_value(function, name, text.substr(equal + 1));
    if (!number) return fail(ErrorKind::usage, "--speed-value {}: {}", text, number.error().message);
    bool used = false;
    for (solver::SpeedTerm& term : setting.terms) {
      if (term.function != function) continue;
      term.values[name] = *number;
      used = true;
    }
    if (!used) return fail(ErrorKind::usage, "--speed-value {}: there is no --speed {}", text, function);
  }
  if (const Status good = solver::check(setting); !good) {
    return fail(ErrorKind::usage, "--speed: {}", good.error().message);
  }
  return setting;
}

Result<std::shared_ptr<const solver::Strokes>> read_examples(const std::string& file, const Geometry& grid,
                                                             Console& console) {
  const auto labels = imaging::load_volume(file, {}, console.progress());
  if (!labels) return pass_on(labels);
  const auto values = imaging::onto_grid(*labels, grid, file);
  if (!values) return pass_on(values);
  auto strokes = std::make_shared<solver::Strokes>();
  for (std::size_t i = 0; i < values->size(); ++i) {
    const float label = (*values)[i];
    if (label == 0.0F) continue;
    if (label != 1.0F && label != 2.0F) {
      return fail(ErrorKind::input, "{}: {} is neither 1 (inside) nor 2 (outside)", file, label);
    }
    (label == 1.0F ? strokes->inside : strokes->outside).push_back(static_cast<std::int64_t>(i));
  }
  for (const auto& [list, text] :
       {std::pair(&strokes->inside, "1 (inside)"), std::pair(&strokes->outside, "2 (outside)")}) {
    if (list->empty()) return fail(ErrorKind::input, "{}: no voxel is {}", file, text);
  }
  return strokes;
}

Status add_mask(solver::Constraints& constraints, const std::optional<std::string>& file,
                solver::Constraint what, const StudyPlace& study, Console& console) {
  if (!file) return {};
  const auto mask = read_mask(*file, study, console);
  if (!mask) return pass_on(mask);
  constraints.set(BitMask(*mask), what);
  return {};
}

Result<std::shared_ptr<const solver::Constraints>> read_constraints(const DriveOptions& options,
                                                                    const StudyPlace& study,
                                                                    Console& console) {
  if (!options.walls && !options.anchors) return nullptr;
  auto constraints = std::make_shared<solver::Constraints>(study.grid.size);
  TIDEMARK_TRY(add_mask(*constraints, options.anchors, solver::Constraint::anchor, study, console));
  TIDEMARK_TRY(add_mask(*constraints, options.walls, solver::Constraint::wall, study, console));
  return constraints;
}

}  // namespace

bool DriveOptions::uses_tent() const {
  return functions.empty() || uses(*this, "tent");
}

DriveOptions DriveOptions::without_unused_files() const {
  DriveOptions used = *this;
  const auto setting = setting_of(*this);
  if (setting && !document::uses_images(*setting)) used.images.clear();
  if (!uses(*this, "image")) used.map.reset();
  return used;
}

void add_image_options(CLI::App& app, DriveOptions& options) {
  app.add_option(
         "--image", options.images,
         "With --speed examples: a further image of the patient on any grid, to learn from, too;\nmay "
         "be repeated")
      ->allow_extra_args(false)
      ->type_name("FILE")
      ->group(kSpeedGroup);
  app.add_option(
         "--speed-image", options.map,
         "With --speed image: a probability (0 to 1) or a speed (-1 to 1), as a volume file on the same\n"
         "grid, a DICOM parametric map or a DICOM segmentation (its fractions)")
      ->type_name("FILE")
      ->group(kSpeedGroup);
}

void add_drive_options(CLI::App& app, DriveOptions& options) {
  std::string text = "What drives the surface (default: tent); may be repeated:";
  for (const solver::SpeedKind& kind : solver::speed_kinds())
    text += fmt::format("\n{}: {}", kind.name, kind.text);
  app.add_option("--speed", options.functions, text)
      ->allow_extra_args(false)
      ->type_name(function_names())
      ->group(kSpeedGroup);
  add_choice<std::optional<solver::Combine>>(
      app, "--combine", options.combine,
      {{"least", solver::Combine::least}, {"product", solver::Combine::product}},
      "Of several: the least speed (default), or the product of their probabilities")
      ->group(kSpeedGroup);
  app.add_option("--speed-value", options.values, values_help())
      ->allow_extra_args(false)
      ->type_name("FUNCTION.NAME=NUMBER")
      ->group(kSpeedGroup);
  add_image_options(app, options);
  app.add_option("--examples", options.examples,
                 "With --speed examples: a label file on the same grid, 1 inside and 2 outside")
      ->type_name("LABELS")
      ->group(kSpeedGroup);
  app.add_option("--walls", options.walls,
                 "Voxels that the surface may never enclose: a mask on the same grid")
      ->type_name("MASK")
      ->group(kSpeedGroup);
  app.add_option("--anchors", options.anchors,
                 "Voxels that the surface always encloses: a mask on the same grid")
      ->type_name("MASK")
      ->group(kSpeedGroup);
}

void add_within_option(CLI::App& app, DriveOptions& options) {
  add_number(app, "--within", options.within_mm,
             "With --init: the surface stays within so many mm of the mask's")
      ->group(kSpeedGroup);
}

Status check(const DriveOptions& options, bool starts_from_mask) {
  const auto setting = setting_of(options);
  if (!setting) return pass_on(setting);
  if (uses(options, "examples") != options.examples.has_value()) {
    return fail(ErrorKind::usage, "--speed examples and --examples need each other");
  }
  if (uses(options, "image") != options.map.has_value()) {
    return fail(ErrorKind::usage, "--speed image and --speed-image need each other");
  }
  if (!options.images.empty() && !document::uses_images(*setting)) {
    return fail(ErrorKind::usage, "--image {} needs a speed function of several images: --speed examples",
                options.images.front());
  }
  if (options.combine && options.functions.size() < 2) {
    return fail(ErrorKind::usage, "--combine needs several --speed to join");
  }
  if (options.within_mm && *options.within_mm <= 0.0) {
    return fail(ErrorKind::usage, "--within {}: must be greater than 0 mm", *options.within_mm);
  }
  if (options.within_mm && !starts_from_mask) return fail(ErrorKind::usage, "--within needs --init");
  return {};
}

Status check_tent(const DriveOptions& options, bool has_target, bool has_range) {
  if (options.uses_tent() || !(has_target || has_range)) return {};
  return fail(ErrorKind::usage, "{} needs --speed tent among --speed, or no --speed at all",
              has_target ? "--target" : "--range");
}

std::vector<std::string> inputs_of(const DriveOptions& options) {
  std::vector<std::string> inputs = options.images;
  for (const auto& input : {options.examples, options.map, options.walls, options.anchors}) {
    if (input) inputs.push_back(*input);
  }
  return inputs;
}

Result<std::shared_ptr<const document::Drive>> make_drive(const DriveOptions& options,
                                                          const StudyPlace& study, Console& console) {
  document::Drive drive;
  auto setting = setting_of(options);
  if (!setting) return pass_on(setting);
  drive.setting = std::move(*setting);
  for (const std::string& file : options.images) {
    auto image = read_image(file, console);
    if (!image) return pass_on(image);
    auto there = placed(*image, file, study, console);
    if (!there) return pass_on(there);
    drive.images.push_back(std::move(*there));
  }
  if (options.map) {
    auto map = read_speed_map(*options.map, study, console);
    if (!map) return pass_on(map);
    drive.map = std::move(*map);
  }
  if (options.examples) {
    auto strokes = read_examples(*options.examples, study.grid, console);
    if (!strokes) return pass_on(strokes);
    drive.strokes = std::move(*strokes);
  }
  auto constraints = read_constraints(options, study, console);
  if (!constraints) return pass_on(constraints);
  drive.constraints = std::move(*constraints);
  if (is_plain(drive)) return nullptr;
  return std::make_shared<const document::Drive>(std::move(drive));
}

}  // namespace tidemark::cli
