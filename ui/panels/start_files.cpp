#include "ui/panels/start_files.h"

#include "imaging/load_study.h"
#include "imaging/onto_grid.h"
#include "imaging/results/results.h"

namespace tidemark::ui {

Result<LoadedStart> load_start(const StartRequest& request, const Progress& progress) {
  const auto& [kind, path, grid, frame_of_reference_uid, band, within_mm, levels] = request;
  const std::string name = path.filename().string();
  document::Start start;
  start.levels = levels;
  if (kind == StartFile::mask) {
    auto loaded = imaging::load_any_mask(path, &grid, progress);
    if (!loaded) return pass_on(loaded);
    document::MaskStart mask{std::make_shared<const BitMask>(loaded->mask), name};
    if (within_mm) {
      auto refined = limited(std::move(mask), *within_mm);
      if (!refined) return pass_on(refined);
      mask = std::move(*refined);
    }
    start.from = std::move(mask);
    std::vector<std::string> remarks = std::move(loaded->changes);
    if (auto remark = imaging::frame_remark(loaded->frames_of_reference, frame_of_reference_uid))
      remarks.push_back(std::move(*remark));
    return LoadedStart{std::move(start), QString::fromStdString(name), std::move(remarks)};
  }
  const auto volume = imaging::load_volume(path, {}, progress);
  if (!volume) return pass_on(volume);
  const auto values = imaging::onto_grid(*volume, grid, name);
  if (!values) return pass_on(values);
  start.from = document::FieldStart{
      std::make_shared<const solver::Field>(solver::Field::from_dense(grid, *values, band)), name};
  return LoadedStart{std::move(start), QString::fromStdString(name), {}};
}

}  // namespace tidemark::ui
