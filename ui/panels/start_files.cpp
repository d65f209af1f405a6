#include "ui/panels/start_files.h"

#include "imaging/onto_grid.h"
#include "imaging/study.h"

namespace tidemark {

Result<Start> load_start(StartFile kind, const std::filesystem::path& path, const Geometry& grid, double band,
                         const Progress& progress) {
  const std::string name = path.filename().string();
  Start start;
  if (kind == StartFile::mask) {
    auto mask = load_mask(path, progress);
    if (!mask) return pass_on(mask);
    auto aligned = onto_grid(std::move(*mask), grid, name);
    if (!aligned) return pass_on(aligned);
    start.from = MaskStart{std::make_shared<const Mask>(std::move(*aligned)), name};
    return start;
  }
  const auto volume = load_volume(path, {}, progress);
  if (!volume) return tl::unexpected<Error>(volume.error());
  const auto values = onto_grid(*volume, grid, name);
  if (!values) return tl::unexpected<Error>(values.error());
  start.from = FieldStart{std::make_shared<const Field>(Field::from_dense(grid, *values, band)), name};
  return start;
}

}  // namespace tidemark
