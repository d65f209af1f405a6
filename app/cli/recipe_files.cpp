#include "app/cli/recipe_files.h"

#include <algorithm>

#include "solver/speed/speed_registry.h"

namespace tidemark::cli {
namespace {

// The images and the map of the command line for the drives of a recipe: each file is read once.
class GivenFiles {
 public:
  GivenFiles(const DriveOptions& options, const StudyPlace& study, Console& console)
      : options_(options), study_(study), console_(console) {}

  // Null stays null.
  Status give(std::shared_ptr<const document::Drive>& drive);
  // Fails naming a file that no drive needed.
  Status all_needed();

 private:
  Status read_images();
  Result<std::size_t> file_of(const document::CaseImage& wanted, std::size_t place);
  Result<std::shared_ptr<const document::CaseImage>> image_for(const document::CaseImage& wanted,
                                                               std::size_t place);
  Result<std::shared_ptr<const document::SpeedMap>> map_for(const document::SpeedMap& wanted);

  const DriveOptions& options_;
  const StudyPlace& study_;
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
  if (!file) return pass_on(file);
  const document::CaseImage& read = images_[*file];
  for (const auto& known : placed_) {
    if (known->volume == read.volume && known->name == wanted.name && known->to_case == wanted.to_case)
      return known;
  }
  document::CaseImage image = wanted;
  image.checksum = read.checksum;
  image.volume = read.volume;
  image.frame_of_reference_uid = read.frame_of_reference_uid;
  auto found = placed(image, options_.images[*file], study_, console_);
  if (found) placed_.push_back(*found);
  return found;
}

Result<std::shared_ptr<const document::SpeedMap>> GivenFiles::map_for(const document::SpeedMap& wanted) {
  if (!options_.map) {
    return fail(ErrorKind::usage, "the recipe needs the map \"{}\": give it with --speed-image", wanted.name);
  }
  if (map_ == nullptr) {
    auto map = read_speed_map(*options_.map, study_, console_);
    if (!map) return map;
    map_ = std::move(*map);
  }
  if (!wanted.checksum.empty() && wanted.checksum != map_->checksum) {
    return fail(ErrorKind::input, "{}: not the recipe's map \"{}\": its voxels differ", *options_.map,
                wanted.name);
  }
  document::SpeedMap map = *map_;
  map.name = wanted.name;
  return std::make_shared<const document::SpeedMap>(std::move(map));
}

Status GivenFiles::give(std::shared_ptr<const document::Drive>& drive) {
  if (drive == nullptr) return {};
  document::Drive given = *drive;
  for (std::size_t i = 0; i < given.images.size(); ++i) {
    auto image = image_for(*given.images[i], i);
    if (!image) return pass_on(image);
    given.images[i] = std::move(*image);
  }
  const bool needs_map = solver::any_has(given.setting, &solver::SpeedKind::needs_map);
  if (given.map != nullptr && (needs_map || options_.map)) {
    auto map = map_for(*given.map);
    if (!map) return pass_on(map);
    given.map = std::move(*map);
  }
  drive = std::make_shared<const document::Drive>(std::move(given));
  return {};
}

Status GivenFiles::all_needed() {
  if (options_.map && map_ == nullptr) {
    return fail(ErrorKind::usage, "--speed-image {}: the recipe needs no map", *options_.map);
  }
  for (std::size_t i = 0; i < options_.images.size(); ++i) {
    const bool needed = i < images_.size() &&
                        std::any_of(placed_.begin(), placed_.end(),
                                    [&](const auto& known) { return known->volume == images_[i].volume; });
    if (!needed) return fail(ErrorKind::usage, "--image {}: the recipe does not need it", options_.images[i]);
  }
  return {};
}

}  // namespace

Status give_images(document::Recipe& recipe, const DriveOptions& options, const StudyPlace& study,
                   Console& console) {
  GivenFiles files(options, study, console);
  TIDEMARK_TRY(files.give(recipe.drive));
  for (document::RecipeEvent& event : recipe.events) {
    if (auto* change = std::get_if<document::DriveEvent>(&event.what)) {
      TIDEMARK_TRY(files.give(change->drive));
    }
  }
  return files.all_needed();
}

}  // namespace tidemark::cli
