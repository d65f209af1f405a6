// An abdomen in CT with a liver whose vessels are filled with contrast medium.
#include <array>
#include <vector>

#include "imaging/phantom/kinds.h"
#include "imaging/phantom/noise.h"
#include "imaging/phantom/scene.h"

namespace tidemark::imaging::phantom {
namespace {

// Hounsfield units.
constexpr double kAir = -1000.0, kLung = -850.0, kFat = -90.0, kBile = 15.0, kMuscle = 65.0;
constexpr double kStomach = 100.0, kLiver = 110.0, kSpleen = 118.0, kKidney = 150.0;
constexpr double kVessel = 190.0, kBone = 380.0;

constexpr double kVoxel = 0.9;

struct Tube {
  glm::dvec3 a, b;
  double radius_a, radius_b;
  // A ball around it.
  glm::dvec3 middle = 0.5 * (a + b);
  double reach = 0.5 * glm::length(b - a) + std::max(radius_a, radius_b);
};

// A vessel that divides in two, each branch thinner and shorter than its parent.
void grow_tree(std::vector<Tube>& tree, std::uint64_t seed, const Tube& stem, int generations) {
  tree.push_back(stem);
  if (generations == 0) return;
  const glm::dvec3 along = stem.b - stem.a;
  const double length = glm::length(along);
  const glm::dvec3 random(gaussian(seed, 0), gaussian(seed, 1), gaussian(seed, 2));
  const glm::dvec3 side = glm::cross(along / length, random);
  const glm::dvec3 aside = side / std::sqrt(glm::dot(side, side) + 1e-6);
  for (const double sign : {-1.0, 1.0}) {
    const glm::dvec3 heading = along / length * 0.8 + aside * (0.65 * sign);
    const double reach = length * (0.75 + 0.15 * uniform(seed, sign > 0 ? 3 : 4));
    const glm::dvec3 end = stem.b + reach / glm::length(heading) * heading;
    const Tube branch{stem.b, end, stem.radius_b, stem.radius_b * 0.74};
    grow_tree(tree, hash(seed, sign > 0 ? 5 : 6), branch, generations - 1);
  }
}

// To the nearest tube, or kFar, where no voxel holds a part of one.
double tubes_distance(const glm::dvec3& p, const std::vector<Tube>& tubes) {
  constexpr double kFar = 2.0 * kVoxel;
  double d = kFar;
  for (const Tube& tube : tubes) {
    const glm::dvec3 aside = p - tube.middle;
    const double within = tube.reach + kFar;
    if (glm::dot(aside, aside) > within * within) continue;
    d = std::min(d, capsule(p, tube.a, tube.b, tube.radius_a, tube.radius_b));
  }
  return d;
}

class Abdomen {
 public:
  explicit Abdomen(std::uint64_t seed)
      : unevenness_(hash(seed, 1), 8, 30.0, 60.0), mottle_(hash(seed, 2), 6, 8.0, 20.0) {
    grow_tree(portal_, hash(seed, 3), {{-14.0, 2.0, -14.0}, {-36.0, -4.0, 0.0}, 6.0, 4.6}, 5);
    grow_tree(portal_, hash(seed, 4), {{-14.0, 2.0, -14.0}, {8.0, -26.0, 16.0}, 5.0, 3.4}, 3);
    grow_tree(veins_, hash(seed, 5), {{-20.0, 26.0, 52.0}, {-44.0, 8.0, 44.0}, 5.5, 4.2}, 4);
  }

  [[nodiscard]] Mixture at(const glm::dvec3& p) const {
    Mixture mixture(kAir);
    const double body = ellipsoid({p.x, p.y, 0.0}, glm::dvec3(0.0), {111.0, 88.0, 1000.0});
    if (body > 2.0) return mixture;
    paint(mixture, kFat, body);
    paint(mixture, kMuscle, body + 9.0);
    paint_wall(mixture, p, body);
    const double cavity = body + 20.0;
    if (cavity < 2.0) paint_cavity(mixture, p, cavity);
    return mixture;
  }

 private:
  static void paint(Mixture& mixture, double value, double distance) {
    mixture.paint(value, coverage(distance, kVoxel));
  }

  // Ribs slant through the wall; the spine stands behind the cavity.
  static void paint_wall(Mixture& mixture, const glm::dvec3& p, double body) {
    const double slanted = p.z + 0.35 * p.y + 0.15 * std::abs(p.x);
    const double nearest = slanted - 26.0 * std::floor(slanted / 26.0 + 0.5);
    const double rib = std::sqrt((body + 15.0) * (body + 15.0) + 0.45 * nearest * nearest) - 4.5;
    if (p.y < 55.0) paint(mixture, kBone, std::max(rib, -20.0 - p.z));
  }

  static void paint_behind(Mixture& mixture, const glm::dvec3& p) {
    const double vertebra = glm::length(glm::dvec2(p.x, p.y - 58.0)) - 17.0;
    paint(mixture, kBone, vertebra);
    paint(mixture, 180.0, vertebra + 2.5);
    paint(mixture, 20.0, glm::length(glm::dvec2(p.x, p.y - 76.0)) - 7.0);
    paint(mixture, kVessel, glm::length(glm::dvec2(p.x - 9.0, p.y - 32.0)) - 8.0);
    paint(mixture, kVessel - 30.0, glm::length(glm::dvec2(p.x + 18.0, p.y - 31.0)) - 9.0);
  }

  void paint_cavity(Mixture& mixture, const glm::dvec3& p, double cavity) const {
    paint(mixture, kFat, cavity);
    const glm::dvec3 mirrored(std::abs(p.x), p.y, p.z);
    paint(mixture, kLung,
          std::max(cavity + 1.0, ellipsoid(mirrored, {48.0, 4.0, 118.0}, {52.0, 66.0, 62.0})));
    paint_behind(mixture, p);
    paint(mixture, kSpleen,
          round_intersection(ellipsoid(p, {60.0, 26.0, 26.0}, {24.0, 34.0, 42.0}), cavity + 3.0, 8.0));
    const double stomach = ellipsoid(p, {43.0, -26.0, 4.0}, {32.0, 28.0, 44.0});
    paint(mixture, kStomach + 15.0, stomach);
    paint(mixture, kStomach, stomach + 4.0);
    const double kidney = ellipsoid(mirrored, {47.0, 40.0, -52.0}, {20.0, 18.0, 40.0});
    paint(mixture, kKidney, kidney);
    paint(mixture, kStomach, kidney + 9.0);
    paint_liver(mixture, p, cavity);
    paint(mixture, kBile, ellipsoid(p, {-22.0, -40.0, -26.0}, {12.0, 13.0, 24.0}));
  }

  void paint_liver(Mixture& mixture, const glm::dvec3& p, double cavity) const {
    double liver = smooth_union(ellipsoid(p, {-48.0, 2.0, 6.0}, {46.0, 52.0, 74.0}),
                                ellipsoid(p, {2.0, -30.0, 24.0}, {50.0, 30.0, 30.0}), 24.0);
    if (liver > 10.0) return;
    liver = round_intersection(liver - 1.5 * unevenness_.value(p), cavity + 2.5, 10.0);
    if (liver > 5.0) return;
    // A film of fat all round, with holes in it where a neighbour adheres: there values alone do not tell the
    // organ's end.
    const double film = coverage(liver - 2.2, kVoxel);
    mixture.paint(kFat, film * (1.0 - coverage(tubes_distance(p, kAdhesions), kVoxel)));
    mixture.paint(kLiver + 4.0 * mottle_.value(p), coverage(liver, kVoxel), true);
    if (liver < 2.0) {
      const double vessels = std::min(tubes_distance(p, portal_), tubes_distance(p, veins_));
      mixture.paint(kVessel, coverage(std::max(vessels, liver + 1.5), kVoxel));
    }
  }

  inline static const std::vector<Tube> kAdhesions = {
      {{8.0, -28.0, 14.0}, {43.0, -26.0, 4.0}, 2.0, 2.0},  // to the stomach
      {{14.0, -30.0, 26.0}, {43.0, -30.0, 16.0}, 2.0, 2.0},
      {{-48.0, 2.0, -20.0}, {-47.0, 40.0, -44.0}, 2.0, 2.0},  // to the right kidney
      {{-48.0, 2.0, 6.0}, {-108.0, 0.0, 10.0}, 2.0, 2.0},     // to the muscles of the wall
  };

  RandomWaves unevenness_;
  RandomWaves mottle_;
  std::vector<Tube> portal_;
  std::vector<Tube> veins_;
};

}  // namespace

Result<Phantom> make_organ(const PhantomOptions& options, ThreadPool& pool, const Progress& progress) {
  const Abdomen abdomen(kShapeSeed);
  Scene scene;
  scene.size = {256, 256, 256};
  scene.spacing_mm = kVoxel;
  scene.modality = "CT";
  scene.description = "Liver with vessels";
  scene.window = {90.0, 300.0};
  scene.brightest = kBone;
  scene.default_noise_percent = 3.0;
  scene.tissue = [&](const glm::dvec3& p) { return abdomen.at(p); };
  Result<Phantom> phantom = scan(scene, options, pool, progress);
  if (!phantom) return phantom;
  phantom->target = kLiver;
  phantom->range = 36.0;
  phantom->alpha = 0.4;
  phantom->seed = seed_at(phantom->volume.geometry, {-64.0, 4.0, -32.0}, 9.0);
  return phantom;
}

}  // namespace tidemark::imaging::phantom
