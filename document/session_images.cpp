#include "document/session_images.h"

#include <algorithm>
#include <map>
#include <utility>

#include "document/checksum.h"
#include "document/session_drives.h"
#include "document/speed_map.h"
#include "imaging/load_study.h"

namespace tidemark::document {
namespace {

using Images = std::vector<std::shared_ptr<const CaseImage>>;

Result<std::shared_ptr<const CaseImage>> read(const CaseImage& wanted, const Progress& progress) {
  if (wanted.path.empty())
    return fail(ErrorKind::input, "the image \"{}\" is missing: its place is not known", wanted.name);
  auto volume = imaging::load_volume(wanted.path, wanted.series_uid, progress, wanted.policy);
  if (!volume && volume.error().kind == ErrorKind::cancelled) return pass_on(volume);
  if (!volume)
    return fail(ErrorKind::input, "the image \"{}\" is missing: {}", wanted.name, volume.error().message);
  if (!wanted.checksum.empty() && checksum_of(*volume, progress.stop) != wanted.checksum) {
    return fail(ErrorKind::input, "the image \"{}\" is missing: {} has other voxels now", wanted.name,
                wanted.path.string());
  }
  auto image = std::make_shared<CaseImage>(wanted);
  image->volume = std::make_shared<const Volume>(std::move(*volume));
  return image;
}

// The one at the same place, else a new one with the same voxels; null: they are not at hand.
std::shared_ptr<const CaseImage> image_for(const CaseImage& wanted, Images& images) {
  std::shared_ptr<const CaseImage> same_voxels;
  for (const auto& image : images) {
    if (wanted.checksum.empty() || image->checksum != wanted.checksum) continue;
    if (image->to_case == wanted.to_case) return image;
    same_voxels = image;
  }
  if (same_voxels == nullptr) return nullptr;
  auto moved = std::make_shared<CaseImage>(*same_voxels);
  moved->to_case = wanted.to_case;
  return images.emplace_back(std::move(moved));
}

Result<std::shared_ptr<const SpeedMap>> read(const SpeedMap& wanted, const Geometry& grid,
                                             const Progress& progress) {
  if (wanted.path.empty())
    return fail(ErrorKind::input, "the map \"{}\" is missing: its place is not known", wanted.name);
  auto map = load_speed_map(wanted.path, grid, progress);
  if (!map && map.error().kind == ErrorKind::cancelled) return map;
  if (!map) return fail(ErrorKind::input, "the map \"{}\" is missing: {}", wanted.name, map.error().message);
  if ((*map)->checksum != wanted.checksum) {
    return fail(ErrorKind::input, "the map \"{}\" is missing: {} has other values now", wanted.name,
                wanted.path.string());
  }
  return map;
}

using Problems = std::vector<std::string>;
using Maps = std::map<std::string, std::shared_ptr<const SpeedMap>>;  // by checksum

// Gives the drive its map, and tells when it cannot be had. Each map is looked for once.
void give_map(Drive& drive, Maps& looked_at, const Geometry& grid, const Progress& progress,
              Problems& problems) {
  if (drive.map == nullptr || drive.map->volume != nullptr) return;
  const auto [known, is_new] = looked_at.try_emplace(drive.map->checksum, drive.map);
  if (is_new) {
    auto found = read(*drive.map, grid, progress);
    if (found) {
      known->second = std::move(*found);
    } else {
      problems.push_back(found.error().message);
    }
  }
  drive.map = known->second;
}

// Gives the drive its images that are at hand.
void give_images(Drive& drive, Images& images) {
  for (auto& image : drive.images) {
    if (auto found = image_for(*image, images)) image = std::move(found);
  }
}

// Looks for the drive's images that are not at hand but have a place. Each is looked for once: one that
// cannot be had is then at hand without voxels.
void add_images(const Drive& drive, Images& images, const Progress& progress, Problems& problems) {
  for (const auto& image : drive.images) {
    if (image->path.empty() || image->checksum.empty() || image_for(*image, images) != nullptr) continue;
    auto found = read(*image, progress);
    images.push_back(found ? *found : image);
    if (!found) problems.push_back(found.error().message);
  }
}

}  // namespace

void give_images(Recipe& recipe, std::vector<std::shared_ptr<const CaseImage>> images) {
  recipe.change_drives([&](Drive& drive) { give_images(drive, images); });
}

std::vector<std::string> find_images(SessionContents& contents, const Progress& progress) {
  Maps maps;
  Problems problems;
  change_drives(contents,
                [&](Drive& drive) { give_map(drive, maps, contents.geometry, progress, problems); });
  for (auto& image : contents.images) {
    auto found = read(*image, progress);
    if (found) {
      image = std::move(*found);
    } else {
      problems.push_back(found.error().message);
    }
  }
  Images images = contents.images;
  change_drives(contents, [&](Drive& drive) {
    add_images(drive, images, progress, problems);
    give_images(drive, images);
  });
  return problems;
}

}  // namespace tidemark::document
