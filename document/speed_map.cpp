#include "document/speed_map.h"

#include "document/checksum.h"
#include "imaging/load_study.h"
#include "imaging/onto_grid.h"
#include "imaging/resample.h"
#include "imaging/results/results.h"

namespace tidemark::document {
namespace {

// A volume file has the study's voxels. Frames of DICOM objects may be fewer, or on a grid of their own:
// where they are not, the surface shrinks.
Result<std::vector<float>> values_of(const std::filesystem::path& file, const Geometry& grid,
                                     const Progress& progress) {
  const bool is_dicom = imaging::holds_map(file);
  const auto loaded = is_dicom ? imaging::read_map(file) : imaging::load_volume(file, {}, progress);
  if (!loaded) return pass_on(loaded);
  auto same = imaging::onto_grid(*loaded, grid, file.string());
  if (same || !is_dicom) return same;
  const float outside = loaded->range().first < 0.0F ? -1.0F : 0.0F;
  auto resampled = imaging::resample(*loaded, glm::dmat4(1.0), grid, file.string(), progress, outside);
  if (!resampled) return fail(ErrorKind::input, "{}", resampled.error().message);
  return std::move(std::get<std::vector<float>>(resampled->volume.voxels));
}

}  // namespace

Result<std::shared_ptr<const SpeedMap>> load_speed_map(const std::filesystem::path& file,
                                                       const Geometry& grid, const Progress& progress) {
  auto values = values_of(file, grid, progress);
  if (!values) return pass_on(values);
  auto volume = std::make_shared<Volume>();
  volume->geometry = grid;
  volume->voxels = std::move(*values);
  return std::make_shared<const SpeedMap>(
      SpeedMap{file.filename().string(), checksum_of(*volume, progress.stop), volume, file});
}

}  // namespace tidemark::document
