#include "document/speed_map.h"

#include "document/checksum.h"
#include "imaging/load_study.h"
#include "imaging/onto_grid.h"

namespace tidemark::document {

Result<std::shared_ptr<const SpeedMap>> load_speed_map(const std::filesystem::path& file,
                                                       const Geometry& grid, const Progress& progress) {
  const auto loaded = imaging::load_volume(file, {}, progress);
  if (!loaded) return tl::unexpected<Error>(loaded.error());
  auto values = imaging::onto_grid(*loaded, grid, file.string());
  if (!values) return pass_on(values);
  auto volume = std::make_shared<Volume>();
  volume->geometry = grid;
  volume->voxels = std::move(*values);
  return std::make_shared<const SpeedMap>(
      SpeedMap{file.filename().string(), checksum_of(*volume, progress.stop), volume});
}

}  // namespace tidemark::document
