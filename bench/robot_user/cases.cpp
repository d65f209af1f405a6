#include "cases.h"

#include <algorithm>
#include <cmath>

#include "imaging/load_study.h"
#include "imaging/onto_grid.h"

namespace tidemark {
namespace {

std::vector<CaseFiles> all_cases() {
  const std::string v02 = "v02_itksnap_mricrop/MRIcrop-orig.gipl.gz";
  const std::string v02_label = "v02_itksnap_mricrop/MRIcrop-seg.gipl.gz";
  const std::string v04 = "v04_ct_body_3mm/example_ct.nii.gz";
  const std::string v04_label = "v04_ct_body_3mm/example_seg_fast_force_split.nii.gz";
  const std::string v09 = "v09_ms_four_channels/";
  const std::string v10 = "v10_sarcoma_pet_ct_mr/";
  std::vector<CaseFiles> cases = {
      {"d21-sarcoma-T1",
       {"d21_sarcoma_mr_rtstruct/MR_T1/image"},
       "d21_sarcoma_mr_rtstruct/MR_T1_mask.nii.gz"},
      {"v10-CT", {v10 + "CT_image.nii.gz"}, v10 + "CT_mask.nii.gz"},
      {"v10-CT+PET", {v10 + "CT_image.nii.gz", v10 + "PET_image.nii.gz"}, v10 + "CT_mask.nii.gz"},
      {"v10-T1", {v10 + "MR_T1_image.nii.gz"}, v10 + "MR_T1_mask.nii.gz"}};
  for (const char* number : {"001", "003", "004", "006", "007", "008"}) {
    const std::string file = std::string("hippocampus_") + number + ".nii.gz";
    cases.push_back({std::string("v07-hippocampus-") + number,
                     {"v07_hippocampus/images/" + file},
                     "v07_hippocampus/labels/" + file});
  }
  cases.push_back({"v04-kidney", {v04}, v04_label, {2}});
  cases.push_back({"v04-spleen", {v04}, v04_label, {1}});
  cases.push_back({"d02-spleen",
                   {"d02_ct_body_j2k_siemens/example_ct_dicom"},
                   "d02_ct_body_j2k_siemens/example_seg_dicom.nii.gz",
                   {1}});
  for (const int label : {2, 3, 7, 8}) {
    cases.push_back({"v02-label" + std::to_string(label), {v02}, v02_label, {label}});
  }
  cases.push_back(
      {"v03-tumour", {"v03_tumour_brain1/brain1_image.nrrd"}, "v03_tumour_brain1/brain1_label.nrrd"});
  cases.push_back({"v05-aorta",
                   {"v05_aorta_mra_levelset/aorta.mha"},
                   "v05_aorta_mra_levelset/aorta-final-levelset.mha",
                   {},
                   true});
  cases.push_back({"v09-FLAIR", {v09 + "FLAIR.nii.gz"}, v09 + "lesions.nii.gz", {}, false, true});
  cases.push_back({"v09-FLAIR+T1+T2",
                   {v09 + "FLAIR.nii.gz", v09 + "T1.nii.gz", v09 + "T2.nii.gz"},
                   v09 + "lesions.nii.gz",
                   {},
                   false,
                   true});
  return cases;
}

// The image at the grid's voxels, trilinear; beyond its end the nearest value.
Volume resampled(const Volume& image, const Geometry& grid) {
  Volume result = image;
  result.geometry = grid;
  result.slope = 1.0;
  result.intercept = 0.0;
  std::vector<float> values(static_cast<std::size_t>(grid.voxel_count()));
  const Index3 last = image.geometry.size - Index3(1);
  for (std::int64_t i = 0; i < grid.voxel_count(); ++i) {
    const glm::dvec3 voxel(grid.voxel_at(i));
    const glm::dvec3 p =
        glm::clamp(image.geometry.to_voxel(grid.to_patient(voxel)), glm::dvec3(0.0), glm::dvec3(last));
    const Index3 low(p);
    const glm::dvec3 w = p - glm::dvec3(low);
    double sum = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
      const Index3 side(corner & 1, corner >> 1 & 1, corner >> 2);
      const glm::dvec3 share = glm::mix(1.0 - w, w, glm::dvec3(side));
      sum += share.x * share.y * share.z * static_cast<double>(image.value(glm::min(low + side, last)));
    }
    values[static_cast<std::size_t>(i)] = static_cast<float>(sum);
  }
  result.voxels = std::move(values);
  return result;
}

}  // namespace

const std::vector<CaseFiles>& robot_cases() {
  static const std::vector<CaseFiles> cases = all_cases();
  return cases;
}

Result<RobotCase> load_case(const std::filesystem::path& folder, const CaseFiles& files) {
  RobotCase result{files.name, files.many, {}, {}};
  for (const std::string& file : files.images) {
    auto image = imaging::load_volume(folder / file);
    if (!image) return pass_on(image);
    if (!result.images.empty()) {
      const Geometry& grid = result.images.front()->geometry;
      if (!same_grid(image->geometry, grid, 0.01)) *image = resampled(*image, grid);
    }
    result.images.push_back(std::make_shared<const Volume>(std::move(*image)));
  }
  auto label = imaging::load_volume(folder / files.label);
  if (!label) return pass_on(label);
  const Geometry& grid = result.images.front()->geometry;
  auto values = imaging::onto_grid(*label, grid, files.label);
  if (!values) return pass_on(values);
  result.truth = {grid, std::vector<std::uint8_t>(values->size())};
  for (std::size_t i = 0; i < values->size(); ++i) {
    const float value = (*values)[i];
    const bool among =
        std::find(files.values.begin(), files.values.end(), std::lround(value)) != files.values.end();
    result.truth.voxels[i] = files.below_zero ? value < 0.0F : files.values.empty() ? value > 0.0F : among;
  }
  return result;
}

}  // namespace tidemark
