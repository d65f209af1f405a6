#include "document/speed_map.h"

#include "document/checksum.h"
#include "imaging/load_study.h"
#include "imaging/onto_grid.h"
#include "imaging/resample.h"
#include "imaging/results/results.h"
#include "solver/speed/image_speed.h"

namespace tidemark::document {
namespace {

// A volume file has the study's voxels: of it nothing is said about covered ones.
Result<imaging::LoadedMap> load_map(const std::filesystem::path& file, const Progress& progress) {
  if (imaging::holds_map(file)) return imaging::read_map(file);
  auto loaded = imaging::load_with_series(file, {}, progress);
  if (!loaded) return pass_on(loaded);
  return imaging::LoadedMap{std::move(loaded->volume), {}, std::move(loaded->series.frame_of_reference_uid)};
}

// Frames of DICOM objects may be fewer than the study's slices, or on a grid of their own: where they are
// not, the surface shrinks.
Result<std::vector<float>> values_on(const Geometry& grid, imaging::LoadedMap& map, const std::string& file,
                                     const Progress& progress) {
  if (map.covered.empty()) return imaging::onto_grid(map.volume, grid, file);
  const float outside = solver::holds_speed(map.volume) ? -1.0F : 0.0F;
  auto& values = std::get<std::vector<float>>(map.volume.voxels);
  for (std::size_t n = 0; n < values.size(); ++n) {
    if (!map.covered[n]) values[n] = outside;
  }
  if (auto same = imaging::onto_grid(map.volume, grid, file)) return same;
  auto resampled = imaging::resample(map.volume, glm::dmat4(1.0), grid, file, progress, outside);
  if (!resampled) return fail(ErrorKind::input, "{}", resampled.error().message);
  return std::move(std::get<std::vector<float>>(resampled->volume.voxels));
}

}  // namespace

Result<std::shared_ptr<const SpeedMap>> load_speed_map(const std::filesystem::path& file,
                                                       const Geometry& grid, const Progress& progress) {
  auto map = load_map(file, progress);
  if (!map) return pass_on(map);
  auto values = values_on(grid, *map, file.string(), progress);
  if (!values) return pass_on(values);
  auto volume = std::make_shared<Volume>();
  volume->geometry = grid;
  volume->voxels = std::move(*values);
  return std::make_shared<const SpeedMap>(SpeedMap{file.filename().string(),
                                                   checksum_of(*volume, progress.stop), volume, file,
                                                   std::move(map->frame_of_reference_uid)});
}

}  // namespace tidemark::document
