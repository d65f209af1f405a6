// A blobby tumour in a head.
#include "imaging/phantom/kinds.h"
#include "imaging/phantom/noise.h"
#include "imaging/phantom/scene.h"

namespace tidemark::imaging::phantom {
namespace {

// Four lobes that have grown into each other, with an uneven surface. At least 1 mm a mm, so that what is
// far away needs no look at the unevenness.
double tumour_distance(const glm::dvec3& p, const RandomWaves& unevenness) {
  const glm::dvec3 centre(34.0, -14.0, 12.0);
  constexpr double kUnevenness = 2.0;
  const double rough = ball(p, centre, 0.0);
  if (rough > 50.0) return rough - 45.0;
  double d = ellipsoid(p, centre, {28.0, 30.0, 27.0});
  d = smooth_union(d, ball(p, centre + glm::dvec3(4.0, 17.0, 12.0), 17.0), 10.0);
  d = smooth_union(d, ball(p, centre + glm::dvec3(-10.0, -18.0, 6.0), 16.0), 10.0);
  d = smooth_union(d, ball(p, centre + glm::dvec3(8.0, -6.0, -18.0), 16.0), 10.0);
  return d - kUnevenness * unevenness.value(p);
}

}  // namespace

Result<Phantom> make_tumour(const PhantomOptions& options, ThreadPool& pool, const Progress& progress) {
  constexpr double kScalp = 950.0, kSkull = 90.0, kFluid = 220.0, kBrain = 470.0, kTumour = 750.0;
  const RandomWaves unevenness(hash(kShapeSeed, 1), 10, 22.0, 40.0);
  const RandomWaves texture(hash(kShapeSeed, 2), 16, 10.0, 30.0);

  Scene scene;
  scene.size = {256, 256, 175};
  scene.description = "Brain tumour";
  scene.window = {500.0, 1000.0};
  scene.brightest = kScalp;
  scene.default_noise_percent = 2.0;
  scene.tissue = [=](const glm::dvec3& p) {
    Mixture mixture(20.0);
    const double head = ellipsoid(p, {0.0, 4.0, -18.0}, {88.0, 108.0, 100.0});
    if (head > 2.0) return mixture;
    mixture.paint(kScalp, coverage(head));
    mixture.paint(kSkull, coverage(head + 6.0));
    mixture.paint(kFluid, coverage(head + 13.0));
    const double brain = head + 16.0;
    if (brain > 2.0) return mixture;
    const double mottle = texture.value(p);
    mixture.paint(kBrain + 20.0 * mottle, coverage(brain));
    const glm::dvec3 mirrored(std::abs(p.x), p.y, p.z);
    mixture.paint(kFluid, coverage(capsule(mirrored, {10.0, -28.0, 14.0}, {15.0, 32.0, 8.0}, 7.0, 5.0)));
    mixture.paint(kFluid, coverage(std::max(std::abs(p.x) - 1.2, 12.0 - (brain + p.z))));
    mixture.paint(kTumour + 12.0 * mottle, coverage(tumour_distance(p, unevenness)), true);
    return mixture;
  };
  Result<Phantom> phantom = scan(scene, options, pool, progress);
  if (!phantom) return phantom;
  phantom->target = kTumour;
  phantom->range = 110.0;
  phantom->alpha = 0.5;
  phantom->seed = seed_at(phantom->volume.geometry, {34.0, -14.0, 12.0}, 9.0);
  return phantom;
}

}  // namespace tidemark::imaging::phantom
