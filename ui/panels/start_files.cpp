#include "ui/panels/start_files.h"

#include <algorithm>

#include "imaging/study.h"

namespace tidemark {
namespace {

constexpr double kTolerance = 0.1;  // of the smallest spacing: files round their numbers

Status check_grid(const Geometry& of_file, const Geometry& grid, const std::string& name) {
  const glm::dvec3& spacing = grid.spacing_mm;
  if (same_grid(of_file, grid, kTolerance * std::min({spacing.x, spacing.y, spacing.z}))) return {};
  return fail(ErrorKind::input,
              "{}: its grid of {} x {} x {} voxels is not that of the study, {} x {} x {}, or lies elsewhere "
              "in the patient",
              name, of_file.size.x, of_file.size.y, of_file.size.z, grid.size.x, grid.size.y, grid.size.z);
}

}  // namespace

Result<Start> load_start(StartFile kind, const std::filesystem::path& path, const Geometry& grid, double band,
                         const Progress& progress) {
  const std::string name = path.filename().string();
  Start start;
  if (kind == StartFile::mask) {
    auto mask = load_mask(path, progress);
    if (!mask) return pass_on(mask);
    if (auto status = check_grid(mask->geometry, grid, name); !status) return pass_on(status);
    mask->geometry = grid;
    start.from = MaskStart{std::make_shared<const Mask>(std::move(*mask)), name};
    return start;
  }
  auto volume = load_volume(path, {}, progress);
  if (!volume) return pass_on(volume);
  if (auto status = check_grid(volume->geometry, grid, name); !status) return pass_on(status);
  std::vector<float> values = volume->values();
  const auto limit = static_cast<float>(band);
  for (float& value : values) value = std::clamp(value, -limit, limit);
  start.from = FieldStart{std::make_shared<const Field>(Field::from_dense(grid, values, band)), name};
  return start;
}

}  // namespace tidemark
