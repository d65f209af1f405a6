#include "app/cli/drive_options.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "app/cli/arguments.h"
#include "document/checksum.h"
#include "document/speed_map.h"
#include "imaging/load_study.h"
#include "imaging/onto_grid.h"
#include "imaging/resample.h"
#include "imaging/results/results.h"
#include "solver/distance_transform.h"
#include "solver/speed/speed_registry.h"

namespace tidemark::cli {
namespace {

const char* const kGroup = "Speed";

// "tent|regions|edges"
std::string function_names() {
  std::string names;
  for (const solver::SpeedKind& kind : solver::speed_kinds())
    names += (names.empty() ? "" : "|") + std::string(kind.name);
  return names;
}

// "edges.sigma (mm, 1): ..."
std::string values_help() {
  std::string text = "A number of a speed function; may be repeated:";
  for (const solver::SpeedKind& kind : solver::speed_kinds()) {
    for (const solver::SpeedParameter& number : kind.parameters) {
      text +=
          fmt::format("\n{}.{} ({:g} to {:g}{}{}, default {:g}): {}", kind.name, number.name, number.low,
                      number.high, *number.unit == '\0' ? "" : " ", number.unit, number.initial, number.text);
    }
  }
  return text;
}

bool uses(const DriveOptions& options, const char* function) {
  return std::find(options.functions.begin(), options.functions.end(), function) != options.functions.end();
}

Result<solver::SpeedSetting> setting_of(const DriveOptions& options) {
  solver::SpeedSetting setting;
  setting.combine = options.combine;
  if (!options.functions.empty()) setting.terms.clear();
  for (const std::string& function : options.functions) setting.terms.push_back({function, {}});
  for (const std::string& text : options.values) {
    const std::size_t dot = text.find('.');
    const std::size_t equal = text.find('=');
    if (dot == std::string::npos || equal == std::string::npos || equal < dot) {
      return fail(ErrorKind::usage, "--speed-value {}: FUNCTION.NAME=NUMBER is needed", text);
    }
    const auto number = parse_number(std::string_view(text).substr(equal + 1));
    if (!number) return fail(ErrorKind::usage, "--speed-value {}: {}", text, number.error().message);
    const std::string function = text.substr(0, dot);
    bool used = false;
    for (solver::SpeedTerm& term : setting.terms) {
      if (term.function != function) continue;
      term.values[text.substr(dot + 1, equal - dot - 1)] = *number;
      used = true;
    }
    if (!used) return fail(ErrorKind::usage, "--speed-value {}: there is no --speed {}", text, function);
  }
  if (const Status good = solver::check(setting); !good) {
    return fail(ErrorKind::usage, "--speed: {}", good.error().message);
  }
  return setting;
}

std::string name_of(const std::string& file) {
  return std::filesystem::path(file).filename().string();
}

// On its own grid; place_image() brings it onto that of the case.
Result<document::CaseImage> read_image(const std::string& file, Console& console) {
  auto loaded = imaging::load_volume(file, {}, console.progress());
  if (!loaded) return pass_on(loaded);
  document::CaseImage image;
  image.name = name_of(file);
  image.checksum = document::checksum_of(*loaded);
  image.volume = std::make_shared<const Volume>(std::move(*loaded));
  return image;
}

Result<std::shared_ptr<const document::CaseImage>> place_image(document::CaseImage image,
                                                               const std::string& file, const Geometry& grid,
                                                               Console& console) {
  auto resampled = imaging::resample(*image.volume, image.to_case, grid, file, console.progress());
  if (!resampled) return fail(ErrorKind::input, "{}", resampled.error().message);
  image.resampled = std::make_shared<const Volume>(std::move(resampled->volume));
  return std::make_shared<const document::CaseImage>(std::move(image));
}

Result<std::shared_ptr<const solver::Strokes>> read_examples(const std::string& file, const Geometry& grid,
                                                             Console& console) {
  const auto labels = imaging::load_volume(file, {}, console.progress());
  if (!labels) return tl::unexpected<Error>(labels.error());
  const auto values = imaging::onto_grid(*labels, grid, file);
  if (!values) return tl::unexpected<Error>(values.error());
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
                solver::Constraint what, const Geometry& grid, Console& console) {
  if (!file) return {};
  const auto mask = imaging::load_any_mask(*file, &grid, console.progress());
  if (!mask) return tl::unexpected<Error>(mask.error());
  for (const std::string& change : mask->changes) console.warn(*file + ": " + change);
  constraints.set(mask->mask, what);
  return {};
}

Result<std::shared_ptr<const solver::Constraints>> read_constraints(const DriveOptions& options,
                                                                    const Geometry& grid, Console& console) {
  if (!options.walls && !options.anchors) return nullptr;
  auto constraints = std::make_shared<solver::Constraints>(grid.size);
  TIDEMARK_TRY(add_mask(*constraints, options.anchors, solver::Constraint::anchor, grid, console));
  TIDEMARK_TRY(add_mask(*constraints, options.walls, solver::Constraint::wall, grid, console));
  return constraints;
}

// The images and the map of the command line for the drives of a recipe: each file is read once.
class GivenFiles {
 public:
  GivenFiles(const DriveOptions& options, const Geometry& grid, Console& console)
      : options_(options), grid_(grid), console_(console) {}

  // Null stays null.
  Status give(std::shared_ptr<const document::Drive>& drive);

 private:
  Status read_images();
  Result<std::size_t> file_of(const document::CaseImage& wanted, std::size_t place);
  Result<std::shared_ptr<const document::CaseImage>> image_for(const document::CaseImage& wanted,
                                                               std::size_t place);
  Result<std::shared_ptr<const document::SpeedMap>> map_for(const document::SpeedMap& wanted);

  const DriveOptions& options_;
  const Geometry& grid_;
  Console& console_;
  std::vector<document::CaseImage> images_;  // of the command line, in its order
  std::vector<std::shared_ptr<const document::CaseImage>> placed_;
  std::shared_ptr<const document::SpeedMap> map_;
};

Status GivenFiles::read_images() {
  for (std::size_t i = images_.size(); i < options_.images.size(); ++i) {
    auto image = read_image(options_.images[i], console_);
    if (!image) return pass_on(image);
    images_.push_back(std::move(*image));
  }
  return {};
}

// By its voxels; an image of unknown voxels is the one at the same place of the command line.
Result<std::size_t> GivenFiles::file_of(const document::CaseImage& wanted, std::size_t place) {
  TIDEMARK_TRY(read_images());
  for (std::size_t i = 0; i < images_.size(); ++i) {
    if (wanted.checksum.empty() ? i == place : images_[i].checksum == wanted.checksum) return i;
  }
  if (place >= images_.size()) {
    return fail(ErrorKind::usage, "the recipe needs the image \"{}\": give it with --image", wanted.name);
  }
  return fail(ErrorKind::input, "{}: not the recipe's image \"{}\": its voxels differ",
              options_.images[place], wanted.name);
}

Result<std::shared_ptr<const document::CaseImage>> GivenFiles::image_for(const document::CaseImage& wanted,
                                                                         std::size_t place) {
  const auto file = file_of(wanted, place);
  if (!file) return tl::unexpected<Error>(file.error());
  const document::CaseImage& read = images_[*file];
  for (const auto& placed : placed_) {
    if (placed->volume == read.volume && placed->name == wanted.name && placed->to_case == wanted.to_case)
      return placed;
  }
  document::CaseImage image = wanted;
  image.checksum = read.checksum;
  image.volume = read.volume;
  auto placed = place_image(std::move(image), options_.images[*file], grid_, console_);
  if (placed) placed_.push_back(*placed);
  return placed;
}

Result<std::shared_ptr<const document::SpeedMap>> GivenFiles::map_for(const document::SpeedMap& wanted) {
  if (!options_.map) {
    return fail(ErrorKind::usage, "the recipe needs the map \"{}\": give it with --speed-image", wanted.name);
  }
  if (map_ == nullptr) {
    auto map = document::load_speed_map(*options_.map, grid_, console_.progress());
    if (!map) return map;
    map_ = std::move(*map);
  }
  if (!wanted.checksum.empty() && wanted.checksum != map_->checksum) {
    return fail(ErrorKind::input, "{}: not the recipe's map \"{}\": its voxels differ", *options_.map,
                wanted.name);
  }
  return std::make_shared<const document::SpeedMap>(
      document::SpeedMap{wanted.name, map_->checksum, map_->volume});
}

Status GivenFiles::give(std::shared_ptr<const document::Drive>& drive) {
  if (drive == nullptr) return {};
  document::Drive given = *drive;
  for (std::size_t i = 0; i < given.images.size(); ++i) {
    auto image = image_for(*given.images[i], i);
    if (!image) return pass_on(image);
    given.images[i] = std::move(*image);
  }
  if (given.map != nullptr) {
    auto map = map_for(*given.map);
    if (!map) return pass_on(map);
    given.map = std::move(*map);
  }
  drive = std::make_shared<const document::Drive>(std::move(given));
  return {};
}

}  // namespace

bool DriveOptions::uses_tent() const {
  return functions.empty() || uses(*this, "tent");
}

void add_image_options(CLI::App& app, DriveOptions& options) {
  app.add_option("--image", options.images,
                 "A further image of the patient on any grid, for speed functions of several images;\nmay be "
                 "repeated")
      ->allow_extra_args(false)
      ->type_name("FILE")
      ->group(kGroup);
  app.add_option("--speed-image", options.map,
                 "With --speed image: a map on the same grid, a probability (0 to 1) or a speed (-1 to 1)")
      ->type_name("FILE")
      ->group(kGroup);
}

void add_drive_options(CLI::App& app, DriveOptions& options) {
  std::string text = "What drives the surface (default: tent); may be repeated:";
  for (const solver::SpeedKind& kind : solver::speed_kinds())
    text += fmt::format("\n{}: {}", kind.name, kind.text);
  app.add_option("--speed", options.functions, text)
      ->allow_extra_args(false)
      ->type_name(function_names())
      ->group(kGroup);
  add_choice<solver::Combine>(app, "--combine", options.combine,
                              {{"least", solver::Combine::least}, {"product", solver::Combine::product}},
                              "Of several: the least speed (default), or the product of their probabilities")
      ->group(kGroup);
  app.add_option("--speed-value", options.values, values_help())
      ->allow_extra_args(false)
      ->type_name("FUNCTION.NAME=NUMBER")
      ->group(kGroup);
  add_image_options(app, options);
  app.add_option("--examples", options.examples,
                 "With --speed examples: a label file on the same grid, 1 inside and 2 outside")
      ->type_name("LABELS")
      ->group(kGroup);
  app.add_option("--walls", options.walls,
                 "Voxels that the surface may never enclose: a mask on the same grid")
      ->type_name("MASK")
      ->group(kGroup);
  app.add_option("--anchors", options.anchors,
                 "Voxels that the surface always encloses: a mask on the same grid")
      ->type_name("MASK")
      ->group(kGroup);
}

void add_within_option(CLI::App& app, DriveOptions& options) {
  add_number(app, "--within", options.within_mm,
             "With --init: the surface stays within so many mm of the mask's")
      ->group(kGroup);
}

Status check(const DriveOptions& options, bool starts_from_mask) {
  const auto setting = setting_of(options);
  if (!setting) return tl::unexpected<Error>(setting.error());
  if (uses(options, "examples") != options.examples.has_value()) {
    return fail(ErrorKind::usage, "--speed examples and --examples need each other");
  }
  if (uses(options, "image") != options.map.has_value()) {
    return fail(ErrorKind::usage, "--speed image and --speed-image need each other");
  }
  if (options.within_mm && *options.within_mm <= 0.0) {
    return fail(ErrorKind::usage, "--within {}: must be greater than 0 mm", *options.within_mm);
  }
  if (options.within_mm && !starts_from_mask) return fail(ErrorKind::usage, "--within needs --init");
  return {};
}

std::vector<std::string> inputs_of(const DriveOptions& options) {
  std::vector<std::string> inputs = options.images;
  for (const auto& input : {options.examples, options.map, options.walls, options.anchors}) {
    if (input) inputs.push_back(*input);
  }
  return inputs;
}

Result<std::shared_ptr<const document::Drive>> make_drive(const DriveOptions& options, const Geometry& grid,
                                                          Console& console) {
  document::Drive drive;
  auto setting = setting_of(options);
  if (!setting) return pass_on(setting);
  drive.setting = std::move(*setting);
  for (const std::string& file : options.images) {
    auto image = read_image(file, console);
    if (!image) return pass_on(image);
    auto placed = place_image(std::move(*image), file, grid, console);
    if (!placed) return pass_on(placed);
    drive.images.push_back(std::move(*placed));
  }
  if (options.map) {
    auto map = document::load_speed_map(*options.map, grid, console.progress());
    if (!map) return pass_on(map);
    drive.map = std::move(*map);
  }
  if (options.examples) {
    auto strokes = read_examples(*options.examples, grid, console);
    if (!strokes) return pass_on(strokes);
    drive.strokes = std::move(*strokes);
  }
  auto constraints = read_constraints(options, grid, console);
  if (!constraints) return pass_on(constraints);
  drive.constraints = std::move(*constraints);
  if (is_plain(drive)) return nullptr;
  return std::make_shared<const document::Drive>(std::move(drive));
}

Status give_images(document::Recipe& recipe, const DriveOptions& options, const Geometry& grid,
                   Console& console) {
  GivenFiles files(options, grid, console);
  TIDEMARK_TRY(files.give(recipe.drive));
  for (document::RecipeEvent& event : recipe.events) {
    if (auto* change = std::get_if<document::DriveEvent>(&event.what)) {
      TIDEMARK_TRY(files.give(change->drive));
    }
  }
  return {};
}

}  // namespace tidemark::cli
