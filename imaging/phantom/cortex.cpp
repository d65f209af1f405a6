// A folded sheet of even thickness: the largest surface for its volume that a head has to offer.
#include "imaging/phantom/folds.h"
#include "imaging/phantom/kinds.h"
#include "imaging/phantom/scene.h"

namespace tidemark::imaging::phantom {
namespace {

// A voxel in the middle of the sheet: of its first stretch on the way out to the back (+y).
Index3 voxel_of_the_sheet(const Mask& truth) {
  const Geometry& geometry = truth.geometry;
  Index3 v(geometry.size.x / 2, geometry.size.y / 2, geometry.size.z / 2);
  const auto inside = [&] { return truth.voxels[static_cast<std::size_t>(geometry.offset(v))] != 0; };
  while (v.y + 1 < geometry.size.y && !inside()) ++v.y;
  const std::int64_t first = v.y;
  while (v.y + 1 < geometry.size.y && inside()) ++v.y;
  v.y = (first + v.y - 1) / 2;
  return v;
}

}  // namespace

Result<Phantom> make_cortex(const PhantomOptions& options, ThreadPool& pool, const Progress& progress) {
  constexpr double kFluid = 150.0, kSheet = 350.0, kCore = 550.0;
  constexpr double kHalfThickness = 2.6;
  const glm::dvec3 radii(95.0, 98.0, 74.0);
  const Folds folds(
      hash(kShapeSeed, 1),
      {.wavelength_mm = 19.0, .ridge_mm = 8.0, .valley_mm = 9.0, .fillet_mm = 4.0, .widening_mm = 0.0});
  Scene scene;
  scene.size = {256, 256, 175};
  scene.description = "Folded sheet";
  scene.window = {350.0, 600.0};
  scene.brightest = kCore;
  scene.default_noise_percent = 2.0;
  scene.tissue = [=](const glm::dvec3& p) {
    Mixture mixture(kFluid);
    const double height = ellipsoid(p, glm::dvec3(0.0), radii);
    if (height > 16.0) return mixture;
    if (height < -20.0) {
      mixture.paint(kCore, 1.0);
      return mixture;
    }
    const double scale = glm::length(p / radii);
    const glm::dvec3 foot = p / scale;
    const glm::dvec3 outward = foot / (radii * radii);
    const double d = folds.distance(height, foot, outward / glm::length(outward), scale);
    mixture.paint(kSheet, coverage(d - kHalfThickness), true);
    mixture.paint(kCore, coverage(d + kHalfThickness));
    return mixture;
  };
  Result<Phantom> phantom = scan(scene, options, pool, progress);
  if (!phantom) return phantom;
  phantom->target = kSheet;
  phantom->range = 80.0;
  phantom->alpha = 0.8;
  const glm::dvec3 start(voxel_of_the_sheet(phantom->truth));
  phantom->seed = {start.x, start.y, start.z, 8.0};  // wider than the sheet; a thousand steps and more away
  phantom->init_threshold = {kSheet - 80.0, kSheet + 80.0};
  return phantom;
}

}  // namespace tidemark::imaging::phantom
