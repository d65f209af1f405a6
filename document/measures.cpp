#include "document/measures.h"

#include <cmath>

#include "document/segment_meshes.h"
#include "imaging/resample.h"
#include "solver/statistics.h"

namespace tidemark::document {
namespace {

using Json = nlohmann::ordered_json;

Json point(glm::dvec3 mm) {
  return Json::array({mm.x, mm.y, mm.z});
}

Json chord(const imaging::Chord& chord) {
  return {{"mm", chord.length_mm()}, {"from_mm", point(chord.from_mm)}, {"to_mm", point(chord.to_mm)}};
}

Json values(const ImageValues& image) {
  const imaging::InsideValues& inside = image.values;
  Json object{{"image", image.image},
              {"unit", image.unit},
              {"covered", image.covered},
              {"mean", inside.mean},
              {"standard_deviation", inside.standard_deviation},
              {"smallest", inside.smallest},
              {"largest", inside.largest}};
  for (std::size_t n = 0; n < inside.percentiles.size(); ++n)
    object["percentiles"][std::to_string(std::lround(imaging::kPercentiles[n]))] = inside.percentiles[n];
  if (inside.uptake) {
    object["peak_1ml"] = inside.uptake->peak;
    object["total_glycolysis"] = inside.uptake->total_glycolysis;
  }
  return object;
}

}  // namespace

Result<MeasuredImage> measured_image(const std::string& name, const CaseImage& image, const Geometry& grid) {
  const auto voxels = resampled(image, grid);
  if (!voxels) return pass_on(voxels);
  const imaging::Resampled& all = **voxels;
  return MeasuredImage{name, {*voxels, &all.volume}, {*voxels, &all.covered}};
}

Result<std::vector<MeasuredImage>> images_on(const Geometry& grid, MeasuredImage study,
                                             const std::vector<std::shared_ptr<const CaseImage>>& images,
                                             const Progress& progress) {
  std::vector<MeasuredImage> measured{std::move(study)};
  for (const auto& image : images) {
    if (progress.cancelled()) return cancelled_error();
    if (image->volume == nullptr) continue;
    auto on_case = measured_image(image->name, *image, grid);
    const bool is_elsewhere = !on_case && on_case.error().kind == ErrorKind::usage;
    if (is_elsewhere) continue;
    if (!on_case) return pass_on(on_case);
    measured.push_back(std::move(*on_case));
  }
  return measured;
}

Result<Measures> measure(const Region& region, const Geometry& grid, const std::vector<MeasuredImage>& images,
                         const solver::Field* phi, const Progress& progress) {
  const auto diameters = imaging::diameters_of(region, grid);
  if (!diameters) return fail(ErrorKind::usage, "there is nothing to measure: no voxel is inside");
  Measures measures;
  measures.diameters = *diameters;
  measures.voxels = region.count();
  measures.volume_ml = static_cast<double>(measures.voxels) * grid.voxel_volume_ml();
  const VoxelRange reach = region.bounds();
  for (int axis = 0; axis < 3; ++axis)
    measures.is_cut = measures.is_cut || reach.touches_end(axis, grid.size);
  if (progress.cancelled()) return cancelled_error();
  progress(0.3, "surface");
  const auto surface = phi != nullptr ? mesh_of(*phi) : mesh_of(mask_of(region, grid));
  if (!surface) return pass_on(surface);
  measures.area_mm2 = imaging::mesh_area_mm2(*surface);
  if (phi != nullptr) {
    const solver::SurfaceStatistics statistics = solver::measure(*phi);
    measures.volume_ml = statistics.volume_ml;
    if (!measures.is_cut) measures.area_mm2 = statistics.surface_mm2;
  }
  measures.sphericity = imaging::mesh_sphericity(*surface);
  for (const MeasuredImage& image : images) {
    if (progress.cancelled()) return cancelled_error();
    progress(0.6, "values");
    const Region seen = image.covered ? intersection(region, *image.covered) : region;
    if (seen.empty()) continue;
    auto values = imaging::values_inside(seen, *image.volume, progress, image.covered.get());
    if (!values) return pass_on(values);
    const auto [low, high] = image.volume->common_range();
    const double covered = static_cast<double>(seen.count()) / static_cast<double>(measures.voxels);
    measures.images.push_back({image.name, image.volume->unit, *values,
                               static_cast<double>(high) - static_cast<double>(low), covered});
  }
  return measures;
}

Json to_json(const Measures& measures) {
  const imaging::Diameters& diameters = measures.diameters;
  Json object{{"voxels", measures.voxels},
              {"volume_ml", measures.volume_ml},
              {"area_mm2", measures.area_mm2},
              {"sphericity", measures.sphericity},
              {"longest_diameter", chord(diameters.longest)},
              {"longest_in_slice", chord(diameters.in_slice)},
              {"across_in_slice", chord(diameters.across)},
              {"centre_mm", point(diameters.centre_mm)},
              {"reach_mm", point(diameters.reach_mm)},
              {"main_axes", Json::array()},
              {"images", Json::array()}};
  for (int axis = 0; axis < 3; ++axis) object["main_axes"].push_back(point(diameters.main_axes[axis]));
  for (const ImageValues& image : measures.images) object["images"].push_back(values(image));
  return object;
}

}  // namespace tidemark::document
