// Balls: alone, joined by a neck, and joined by a bridge that leaks.
#include "imaging/phantom/kinds.h"
#include "imaging/phantom/noise.h"
#include "imaging/phantom/scene.h"

namespace tidemark::imaging::phantom {
namespace {

constexpr double kDark = 200.0;
constexpr double kBright = 800.0;
constexpr double kRadius = 20.0;

Scene dark_scene(const Index3& size, std::string description) {
  Scene scene;
  scene.size = size;
  scene.description = std::move(description);
  scene.window = {500.0, 800.0};
  scene.brightest = kBright;
  return scene;
}

// D falls to 0 half-way between dark and bright: where the true boundary runs.
void set_parameters(Phantom& phantom, double alpha) {
  phantom.target = kBright;
  phantom.range = 0.5 * (kBright - kDark);
  phantom.alpha = alpha;
}

}  // namespace

Result<Phantom> make_sphere(const PhantomOptions& options, ThreadPool& pool, const Progress& progress) {
  Scene scene = dark_scene({81, 81, 81}, "Ball");
  scene.tissue = [](const glm::dvec3& p) {
    Mixture mixture(kDark);
    mixture.paint(kBright, coverage(ball(p, glm::dvec3(0.0), kRadius)), true);
    return mixture;
  };
  Result<Phantom> phantom = scan(scene, options, pool, progress);
  if (!phantom) return phantom;
  set_parameters(*phantom, 0.8);
  phantom->seed = seed_at(phantom->volume.geometry, glm::dvec3(0.0), 8.0);
  return phantom;
}

Result<Phantom> make_dumbbell(const PhantomOptions& options, ThreadPool& pool, const Progress& progress) {
  const glm::dvec3 left(-28.0, 0.0, 0.0);
  const glm::dvec3 right(28.0, 0.0, 0.0);
  Scene scene = dark_scene({121, 65, 65}, "Two balls and a neck");
  scene.tissue = [=](const glm::dvec3& p) {
    const double balls = std::min(ball(p, left, kRadius), ball(p, right, kRadius));
    const double neck = capsule(p, left, right, 6.0, 6.0);
    Mixture mixture(kDark);
    mixture.paint(kBright, coverage(smooth_union(balls, neck, 6.0)), true);
    return mixture;
  };
  Result<Phantom> phantom = scan(scene, options, pool, progress);
  if (!phantom) return phantom;
  set_parameters(*phantom, 0.8);
  phantom->seed = seed_at(phantom->volume.geometry, left, 8.0);
  return phantom;
}

Result<Phantom> make_bridge(const PhantomOptions& options, ThreadPool& pool, const Progress& progress) {
  const glm::dvec3 left(-28.0, 0.0, 0.0);
  const glm::dvec3 right(28.0, 0.0, 0.0);
  const std::uint64_t texture = hash(options.random_seed, 0x627269646765);
  Scene scene = dark_scene({121, 65, 65}, "Two balls and a bridge");
  scene.default_noise_percent = 2.0;
  scene.tissue = [=](const glm::dvec3& p) {
    Mixture mixture(kDark);
    // 3 voxels wide. Every voxel of it has a value of its own, all of them well within the range, so that
    // nothing but the curvature of so thin a tube can keep a surface out.
    const glm::dvec3 voxel = glm::floor(p + 1000.5);
    const double roughness =
        uniform(texture, static_cast<std::uint64_t>(voxel.x + 4096.0 * (voxel.y + 4096.0 * voxel.z)));
    mixture.paint(620.0 + 120.0 * roughness, coverage(capsule(p, left, right, 1.4, 1.4)));
    mixture.paint(kBright, coverage(ball(p, right, kRadius)));
    mixture.paint(kBright, coverage(ball(p, left, kRadius)), true);
    return mixture;
  };
  Result<Phantom> phantom = scan(scene, options, pool, progress);
  if (!phantom) return phantom;
  set_parameters(*phantom, 0.6);
  phantom->seed = seed_at(phantom->volume.geometry, left, 8.0);
  return phantom;
}

}  // namespace tidemark::imaging::phantom
