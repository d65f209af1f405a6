#include "ui/panels/start_files.h"

#include "imaging/load_study.h"
#include "imaging/onto_grid.h"
#include "imaging/results/results.h"

namespace tidemark::ui {

Result<document::Start> load_start(const StartRequest& request, const Progress& progress) {
  const auto& [kind, path, grid, band, within_mm, levels] = request;
  const std::string name = path.filename().string();
  document::Start start;
  start.levels = levels;
  if (kind == StartFile::mask) {
    auto loaded = imaging::load_any_mask(path, &grid, progress);
    if (!loaded) return pass_on(loaded);
    document::MaskStart mask{std::make_shared<const Mask>(std::move(loaded->mask)), name};
    if (within_mm) {
      auto refined = limited(std::move(mask), *within_mm);
      if (!refined) return pass_on(refined);
      mask = std::move(*refined);
    }
    start.from = std::move(mask);
    return start;
  }
  const auto volume = imaging::load_volume(path, {}, progress);
  if (!volume) return pass_on(volume);
  const auto values = imaging::onto_grid(*volume, grid, name);
  if (!values) return pass_on(values);
  start.from = document::FieldStart{
      std::make_shared<const solver::Field>(solver::Field::from_dense(grid, *values, band)), name};
  return start;
}

}  // namespace tidemark::ui
