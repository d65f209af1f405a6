#include "document/cohort/case_files.h"

#include <algorithm>

#include "core/atomic_file.h"
#include "document/cohort/case_picture.h"
#include "document/region_statistics.h"
#include "document/segment_meshes.h"
#include "document/truth.h"
#include "imaging/files/png_file.h"
#include "imaging/files/volume_file.h"
#include "imaging/results/results.h"
#include "imaging/surface/surface.h"
#include "solver/inside_region.h"

namespace tidemark::cohort {
namespace {

namespace fs = std::filesystem;

// Of the picture of a case, in pixels: small volumes have no more to show.
int picture_side(const Geometry& grid) {
  constexpr std::int64_t kLeast = 48;
  constexpr std::int64_t kMost = 128;
  return static_cast<int>(std::clamp(std::max({grid.size.x, grid.size.y, grid.size.z}), kLeast, kMost));
}

bool touches_border(const VoxelRange& inside, Index3 grid_size) {
  if (inside.empty()) return false;
  for (int axis = 0; axis < 3; ++axis) {
    // An axis of few voxels has nothing but a border.
    if (grid_size[axis] > 2 && inside.touches_end(axis, grid_size)) return true;
  }
  return false;
}

class CaseFiles {
 public:
  CaseFiles(const CohortPlan& plan, const WorkRow& row, const CaseResult& result, const fs::path& folder,
            CaseStatus& status, const Progress& progress)
      : plan_(plan),
        row_(row),
        result_(result),
        folder_(folder),
        status_(status),
        progress_(progress),
        inside_(solver::inside_region(result.phi)) {}

  Status write();

 private:
  Status measure();
  Status write_outputs();
  Status write_dicom(CaseOutput output, const fs::path& file);
  Status write_recipe();
  Status write_picture();

  const CohortPlan& plan_;
  const WorkRow& row_;
  const CaseResult& result_;
  const fs::path& folder_;
  CaseStatus& status_;
  const Progress& progress_;
  const Region inside_;
};

Status CaseFiles::measure() {
  if (!status_.figures) status_.figures.emplace();
  CaseFigures& figures = *status_.figures;
  figures.volume_ml = result_.surface.volume_ml;
  figures.surface_mm2 = result_.surface.surface_mm2;
  figures.voxels_inside = result_.surface.voxels_inside;
  figures.unit = result_.source.unit;
  if (touches_border(inside_.bounds(), result_.phi.geometry.size))
    status_.warnings.push_back(CaseWarning::touches_border);
  document::ValueSums sums;
  // The sums want stored values: those of a smoothed volume are its own.
  std::visit(
      [&](const auto& voxels) {
        inside_.for_each_run([&](Index3 voxel, std::int64_t length) {
          const auto first = voxels.begin() + result_.source.geometry.offset(voxel);
          std::for_each(first, first + length, [&](auto value) { sums.add(static_cast<double>(value)); });
        });
      },
      result_.source.voxels);
  if (sums.voxels > 0) figures.mean_inside = sums.result(result_.source).mean;
  if (row_.truth.empty()) return {};
  const auto truth = document::load_truth(row_.truth, row_.truth_label, result_.source.geometry, progress_);
  if (!truth) return pass_on(truth);
  figures.dice = dice(inside_, Region(*truth));
  return {};
}

Status CaseFiles::write_picture() {
  const auto picture =
      case_picture(result_.source, result_.phi, picture_side(result_.source.geometry), result_.threads);
  if (!picture) {  // no reason to lose the case
    status_.remarks.push_back("overview.png: is left out: " + picture.error().message);
    return {};
  }
  status_.files.emplace_back("overview.png");
  return imaging::write_png_file(picture->width, picture->height, picture->pixels, folder_ / "overview.png",
                                 imaging::PngEffort::quick);
}

// A start that is too large for a file is no reason to lose the case.
Status CaseFiles::write_recipe() {
  const auto text = result_.recipe.to_text();
  if (!text) {
    status_.remarks.push_back("recipe.json: is left out: " + text.error().message);
    return {};
  }
  status_.files.emplace_back("recipe.json");
  return write_file(folder_ / "recipe.json", *text);
}

Status CaseFiles::write_dicom(CaseOutput output, const fs::path& file) {
  imaging::Segments segments = imaging::segments_of(inside_, result_.phi.geometry, "Segment");
  segments.list.front().phi = std::make_shared<const Volume>(result_.phi.to_volume());
  Status written = output == CaseOutput::segmentation
                       ? imaging::write_segmentation(segments, result_.dicom_files, file, progress_)
                       : imaging::write_structure_set(segments, result_.dicom_files, file, progress_);
  // A grid that DICOM cannot describe is no lack of memory.
  if (!written && written.error().kind == ErrorKind::capability) written.error().kind = ErrorKind::input;
  return written;
}

Status CaseFiles::write_outputs() {
  for (const CaseOutput output : plan_.outputs) {
    constexpr const char* kFiles[] = {"seg.dcm", "rtstruct.dcm", "surface.stl", "phi.nii.gz"};
    const std::string name = kFiles[static_cast<std::size_t>(output)];
    const fs::path file = folder_ / name;
    // Without a voxel inside there is no segment and no surface.
    if (status_.figures->voxels_inside == 0 && output != CaseOutput::level_set) continue;
    switch (output) {
      case CaseOutput::segmentation:
      case CaseOutput::structure_set:
        TIDEMARK_TRY(write_dicom(output, file));
        break;
      case CaseOutput::surface: {
        const auto mesh = document::mesh_of(result_.phi);
        if (!mesh) return pass_on(mesh);
        TIDEMARK_TRY(imaging::write_mesh(*mesh, file));
        break;
      }
      case CaseOutput::level_set:
        TIDEMARK_TRY(imaging::write_volume_file(result_.phi.to_volume(), file));
    }
    status_.files.push_back(name);
  }
  return {};
}

Status CaseFiles::write() {
  TIDEMARK_TRY(measure());
  if (progress_.cancelled()) return cancelled_error();
  status_.files.emplace_back("mask.nii.gz");
  TIDEMARK_TRY(imaging::write_mask_file(result_.phi.mask(), folder_ / "mask.nii.gz"));
  TIDEMARK_TRY(write_outputs());
  TIDEMARK_TRY(write_recipe());
  if (!plan_.pictures) return {};
  return write_picture();
}

}  // namespace

Status write_case_files(const CohortPlan& plan, const WorkRow& row, const CaseResult& result,
                        const fs::path& folder, CaseStatus& status, const Progress& progress) {
  return CaseFiles(plan, row, result, folder, status, progress).write();
}

}  // namespace tidemark::cohort
