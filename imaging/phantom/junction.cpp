// Where two cells touch: two membranes a few voxels apart in a noisy, low-contrast picture of an electron
// microscope.
#include <vector>

#include "imaging/phantom/kinds.h"
#include "imaging/phantom/noise.h"
#include "imaging/phantom/scene.h"

namespace tidemark::imaging::phantom {
namespace {

constexpr double kPlasm = 500.0, kMembrane = 620.0;

class Junction {
 public:
  explicit Junction(std::uint64_t seed)
      : course_(hash(seed, 1), 5, 130.0, 300.0),
        ripple_(hash(seed, 2), 6, 45.0, 80.0),
        mottle_(hash(seed, 3), 5, 12.0, 40.0) {
    place_bridges(hash(seed, 4));
    place_filaments(hash(seed, 5));
  }

  [[nodiscard]] Mixture at(const glm::dvec3& p) const {
    Mixture mixture(kPlasm + 10.0 * mottle_.value(p));
    if (std::abs(p.y) < kReach) mixture.paint(kMembrane, coverage(distance(p)), true);
    return mixture;
  }

 private:
  static constexpr double kReach = 130.0;
  static constexpr double kHalfThickness = 2.5;

  // Half the distance between the membranes: close in the middle, parting towards the ends.
  static double half_gap(double x) {
    const double outside = std::max(std::abs(x) - 120.0, 0.0);
    return 6.0 + outside * outside * 0.0028;
  }
  [[nodiscard]] double middle(double x, double z) const { return 16.0 * course_.value({x, 0.0, z}); }

  [[nodiscard]] double distance(const glm::dvec3& p) const {
    const RandomWaves::Sample course = course_.sample({p.x, 0.0, p.z});
    const double beyond = std::abs(p.y - 16.0 * course.value) - half_gap(p.x) - 60.0;
    if (beyond > 0.0) return beyond;  // further than the strands reach
    const RandomWaves::Sample upper = ripple_.sample({p.x, 0.0, p.z});
    const RandomWaves::Sample lower = ripple_.sample({p.x, 1000.0, p.z});
    const double gap = half_gap(p.x);
    const double parting = std::max(std::abs(p.x) - 120.0, 0.0) * 0.0056;
    const auto sheet = [&](double side, const RandomWaves::Sample& ripple) {
      const double height = p.y - 16.0 * course.value - side * gap - 1.2 * ripple.value;
      const double sx =
          16.0 * course.gradient.x + 1.2 * ripple.gradient.x + side * (p.x > 0 ? 1 : -1) * parting;
      const double sz = 16.0 * course.gradient.z + 1.2 * ripple.gradient.z;
      return std::abs(height) / std::sqrt(1.0 + sx * sx + sz * sz) - kHalfThickness;
    };
    double d = std::min(sheet(1.0, upper), sheet(-1.0, lower));
    for (const glm::dvec3& bridge : bridges_) {
      if (std::abs(p.x - bridge.x) > 12.0 || std::abs(p.z - bridge.z) > 12.0) continue;
      d = smooth_union(d, ellipsoid(p, bridge, {4.0, 6.0, 4.0}), 3.0);
    }
    for (const Filament& filament : filaments_) {
      if (std::abs(p.x - filament.root.x) > 60.0 || std::abs(p.z - filament.root.z) > 30.0) continue;
      d = smooth_union(d, capsule(p, filament.root, filament.tip, 3.0, 2.4), 4.0);
    }
    return d;
  }

  // Bodies that span the gap where the membranes run side by side.
  void place_bridges(std::uint64_t seed) {
    std::uint64_t index = 0;
    for (int row = -2; row <= 2; ++row) {
      for (int column = -7; column <= 7; ++column, index += 3) {
        if (uniform(seed, index) < 0.3) continue;
        const double x = 15.0 * column + 3.0 * gaussian(seed, index + 1);
        const double z = 13.0 * row + 2.0 * gaussian(seed, index + 2);
        bridges_.emplace_back(x, middle(x, z), z);
      }
    }
  }

  // Strands that leave the membranes into the cells.
  void place_filaments(std::uint64_t seed) {
    for (std::uint64_t i = 0; i < 12; ++i) {
      const double side = i % 2 == 0 ? 1.0 : -1.0;
      const double x = -220.0 + 40.0 * static_cast<double>(i) + 8.0 * gaussian(seed, 3 * i);
      const double z = 9.0 * gaussian(seed, 3 * i + 1);
      const glm::dvec3 root(x, middle(x, z) + side * half_gap(x), z);
      const glm::dvec3 tip = root + glm::dvec3(16.0 * gaussian(seed, 3 * i + 2), side * 46.0, 4.0 * side);
      filaments_.push_back({root, tip});
    }
  }

  struct Filament {
    glm::dvec3 root, tip;
  };
  RandomWaves course_, ripple_, mottle_;
  std::vector<glm::dvec3> bridges_;
  std::vector<Filament> filaments_;
};

}  // namespace

Result<Phantom> make_junction(const PhantomOptions& options, ThreadPool& pool, const Progress& progress) {
  const Junction junction(kShapeSeed);
  Scene scene;
  scene.size = {512, 512, 61};
  scene.description = "Membranes of two cells";
  scene.window = {560.0, 400.0};
  scene.brightest = kMembrane;
  scene.default_noise_percent = 9.0;
  scene.tissue = [&](const glm::dvec3& p) { return junction.at(p); };
  Result<Phantom> phantom = scan(scene, options, pool, progress);
  if (!phantom) return phantom;
  phantom->target = 640.0;
  phantom->range = 80.0;
  phantom->alpha = 0.6;
  phantom->init_threshold = {560.0, 720.0};
  return phantom;
}

}  // namespace tidemark::imaging::phantom
