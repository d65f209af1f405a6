// A head as a T1-weighted MR sequence shows it.
#include "imaging/phantom/folds.h"
#include "imaging/phantom/kinds.h"
#include "imaging/phantom/scene.h"

namespace tidemark::imaging::phantom {
namespace {

constexpr double kNothing = 10.0, kBone = 80.0, kWater = 230.0, kMuscle = 430.0, kGrey = 600.0;
constexpr double kWhite = 800.0, kFat = 920.0, kRim = 500.0, kNecrosis = 330.0;

const glm::dvec3 kBrainCentre(0.0, 0.0, 14.0);
const glm::dvec3 kBrainRadii(67.0, 84.0, 60.0);
const glm::dvec3 kTumour(32.0, -26.0, 34.0);

// Everything is symmetric in x but the folds, the tumour and the noise; q is the point with x >= 0.
class Head {
 public:
  explicit Head(std::uint64_t seed)
      : folds_(hash(seed, 1), {.wavelength_mm = 22.0,
                               .ridge_mm = 0.0,
                               .valley_mm = 16.0,
                               .fillet_mm = 2.0,
                               .widening_mm = 3.2}),
        leaves_(hash(seed, 2), 8, 7.0, 10.0),
        mottle_(hash(seed, 3), 8, 12.0, 30.0),
        bias_(hash(seed, 4), 5, 220.0, 400.0) {}

  [[nodiscard]] Mixture at(const glm::dvec3& p) const {
    Mixture mixture(kNothing);
    const glm::dvec3 q(std::abs(p.x), p.y, p.z);
    const double skin = skin_distance(q);
    if (skin > 2.0) return mixture;
    paint_face(mixture, q, skin);
    const double cavity = cavity_distance(q);
    if (cavity < 10.0) {
      // Open below, where the stem becomes the cord.
      mixture.paint(kBone, coverage(round_intersection(cavity - 8.0, -58.0 - p.z, 10.0)));
      // Marrow between the tables of the skull's vault.
      if (p.z > 10.0) mixture.paint(420.0, coverage(std::abs(cavity - 5.0) - 1.0));
      mixture.paint(kWater, coverage(cavity - 1.0));
    }
    if (cavity < 3.0) {
      paint_cerebellum(mixture, q);
      const double mottle = mottle_.value(p);
      paint_hemispheres(mixture, p, q, mottle);
      mixture.paint(kWhite + 8.0 * mottle, coverage(stem_distance(q)), true);
      paint_depth(mixture, q);
      paint_tumour(mixture, p, mottle);
    }
    return mixture;
  }

  // The gain of the receiver coil: 1 in the middle, some 5 to 10 % more or less towards the skin.
  [[nodiscard]] double gain(const glm::dvec3& p) const {
    return 1.0 + std::clamp(0.04 * (bias_.value(p) - bias_.value(kBrainCentre)), -0.1, 0.1);
  }

 private:
  static double hemispheres(const glm::dvec3& q) { return ellipsoid(q, kBrainCentre, kBrainRadii); }
  static double temples(const glm::dvec3& q) {
    return ellipsoid(q, {38.0, -14.0, -20.0}, {24.0, 38.0, 20.0});
  }
  // The floor of the skull is higher in front (eyes) and behind (cerebellum) than at the temples.
  static double cerebrum_envelope(const glm::dvec3& q) {
    return smooth_union(round_intersection(hemispheres(q), -12.0 - q.z, 14.0), temples(q), 12.0);
  }
  static double cerebellum_envelope(const glm::dvec3& q) {
    return ellipsoid(q, {20.0, 48.0, -34.0}, {32.0, 28.0, 22.0});
  }
  static double stem_distance(const glm::dvec3& q) {
    return smooth_union(capsule(q, {0.0, 10.0, -6.0}, {0.0, 20.0, -44.0}, 12.0, 11.0),
                        capsule(q, {0.0, 20.0, -44.0}, {0.0, 30.0, -100.0}, 9.0, 6.5), 6.0);
  }
  static double cavity_distance(const glm::dvec3& q) {
    const double brain = smooth_union(cerebrum_envelope(q), cerebellum_envelope(q) - 1.0, 8.0);
    return smooth_union(brain, stem_distance(q) - 3.0, 6.0);
  }
  static double skin_distance(const glm::dvec3& q) {
    double d = ellipsoid(q, {0.0, 2.0, 12.0}, {81.0, 100.0, 75.5});
    d = smooth_union(d, ellipsoid(q, {0.0, -46.0, -52.0}, {54.0, 48.0, 62.0}), 20.0);
    d = smooth_union(d, capsule(q, {0.0, 30.0, -60.0}, {0.0, 34.0, -140.0}, 52.0, 54.0), 24.0);
    d = smooth_union(d, capsule(q, {0.0, -92.0, -18.0}, {0.0, -103.0, -44.0}, 6.0, 9.0), 8.0);
    return d;
  }

  // What lies around the skull.
  static void paint_face(Mixture& mixture, const glm::dvec3& q, double skin) {
    mixture.paint(kMuscle, coverage(skin));
    mixture.paint(kFat, coverage(skin + 1.5));
    mixture.paint(kMuscle, coverage(std::max(skin + 6.0, q.z + 14.0)));
    const double eye = ball(q, {31.0, -82.0, -14.0}, 12.0);
    mixture.paint(kFat, coverage(eye - 4.0));
    mixture.paint(kWater, coverage(eye));
    mixture.paint(kNothing, coverage(ellipsoid(q, {5.0, -72.0, -42.0}, {4.0, 22.0, 15.0})));
    mixture.paint(kNothing, coverage(ellipsoid(q, {27.0, -66.0, -46.0}, {11.0, 13.0, 13.0})));
    mixture.paint(kNothing, coverage(capsule(q, {0.0, -40.0, -62.0}, {0.0, -22.0, -110.0}, 8.0, 8.0)));
    mixture.paint(kBone, coverage(ellipsoid(q, {30.0, -58.0, -74.0}, {7.0, 26.0, 6.0})));
    // Vertebrae with discs between them.
    const double column = std::max(glm::length(glm::dvec2(q.x, q.y - 6.0)) - 11.0, q.z + 60.0);
    mixture.paint(kWater + 60.0, coverage(column));
    const double middle = q.z - 16.0 * std::floor(q.z / 16.0) - 8.0;
    mixture.paint(kMuscle + 150.0, coverage(round_intersection(column + 0.5, std::abs(middle) - 5.5, 3.0)));
  }

  // Its leaves and its white core, and the stalk that joins that to the stem.
  void paint_cerebellum(Mixture& mixture, const glm::dvec3& q) const {
    const double cerebellum = cerebellum_envelope(q);
    if (cerebellum < 2.0) {
      mixture.paint(kGrey - 40.0 + 30.0 * leaves_.value({0.3 * q.x, q.y, q.z}), coverage(cerebellum + 0.5));
      mixture.paint(kWhite, coverage(cerebellum + 11.0), true);
      mixture.paint(kWater, coverage(ellipsoid(q, {0.0, 36.0, -36.0}, {7.0, 5.0, 11.0})));
    }
    mixture.paint(kWhite, coverage(capsule(q, {8.0, 20.0, -36.0}, {20.0, 44.0, -34.0}, 6.5, 7.0)), true);
  }

  // Signed distance to the surface of the hemispheres, the cleft between them included.
  [[nodiscard]] double pial_distance(const glm::dvec3& p, const glm::dvec3& q) const {
    const double height = smooth_union(hemispheres(q), temples(q), 12.0);
    const glm::dvec3 from_centre = p - kBrainCentre;
    const double scale = std::max(glm::length(from_centre / kBrainRadii), 0.3);
    const glm::dvec3 foot = from_centre / scale;
    const glm::dvec3 outward = foot / (kBrainRadii * kBrainRadii);
    // A pattern of its own for either side.
    const glm::dvec3 place = foot + glm::dvec3(p.x > 0 ? 500.0 : 0.0, 0.0, 0.0);
    const double folded =
        round_intersection(folds_.distance(height + 0.5, place, outward / glm::length(outward), scale),
                           cerebrum_envelope(q) + 1.0, 3.0);
    const double below_cleft = ellipsoid(q, {0.0, 2.0, 4.0}, {40.0, 52.0, 30.0});
    const double cleft = std::max(q.x - 1.0, -below_cleft);
    return round_intersection(folded, -cleft, 3.0);
  }

  void paint_hemispheres(Mixture& mixture, const glm::dvec3& p, const glm::dvec3& q, double mottle) const {
    constexpr double kCortex = 3.0;
    const double pial = pial_distance(p, q);
    if (pial > 2.0) return;
    mixture.paint(kGrey + 8.0 * mottle, coverage(pial));
    mixture.paint(kWhite + 8.0 * mottle, coverage(pial + kCortex), true);
  }

  // Grey nuclei and the ventricles.
  static void paint_depth(Mixture& mixture, const glm::dvec3& q) {
    const double thalamus = ellipsoid(q, {10.0, 8.0, 6.0}, {8.0, 14.0, 9.0});
    const double putamen = ellipsoid(q, {27.0, -6.0, 4.0}, {6.0, 17.0, 10.0});
    const double caudate = capsule(q, {13.0, -22.0, 12.0}, {19.0, 6.0, 22.0}, 6.0, 3.5);
    mixture.paint(kGrey + 30.0, coverage(std::min({thalamus, putamen, caudate})));

    double lateral = capsule(q, {6.0, -26.0, 14.0}, {8.0, 4.0, 22.0}, 5.0, 5.5);
    lateral = smooth_union(lateral, capsule(q, {8.0, 4.0, 22.0}, {20.0, 34.0, 12.0}, 5.5, 6.0), 4.0);
    lateral = smooth_union(lateral, capsule(q, {20.0, 34.0, 12.0}, {30.0, 14.0, -12.0}, 5.0, 3.0), 4.0);
    const double third = std::max({q.x - 2.0, std::abs(q.y - 6.0) - 14.0, std::abs(q.z - 5.0) - 8.0});
    mixture.paint(kWater, coverage(std::min(lateral, third)));
  }

  static void paint_tumour(Mixture& mixture, const glm::dvec3& p, double mottle) {
    const double tumour = ball(p, kTumour, 15.0) - 1.2 * mottle;
    mixture.paint(kRim, coverage(tumour));
    mixture.paint(kNecrosis + 10.0 * mottle, coverage(tumour + 5.0));
  }

  Folds folds_;
  RandomWaves leaves_, mottle_, bias_;
};

}  // namespace

Result<Phantom> make_head(const PhantomOptions& options, ThreadPool& pool, const Progress& progress) {
  const Head head(kShapeSeed);
  Scene scene;
  scene.size = {192, 224, 176};
  scene.description = "T1 head";
  scene.window = {500.0, 1000.0};
  scene.brightest = kFat;
  scene.default_noise_percent = 3.0;
  scene.tissue = [&](const glm::dvec3& p) { return head.at(p); };
  scene.gain = [&](const glm::dvec3& p) { return head.gain(p); };
  Result<Phantom> phantom = scan(scene, options, pool, progress);
  if (!phantom) return phantom;
  // The range ends half-way to grey matter; nothing brighter touches white matter, so it may reach higher.
  phantom->target = 830.0;
  phantom->range = 130.0;
  phantom->alpha = 0.7;
  phantom->seed = seed_at(phantom->volume.geometry, {-28.0, 26.0, 34.0}, 6.0);
  return phantom;
}

}  // namespace tidemark::imaging::phantom
