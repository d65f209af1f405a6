// Which of the mean brightnesses inside and outside of the surface is nearer to a voxel's (Chan and Vese,
// "Active Contours Without Edges", 2001), over the whole volume or around the voxel.
#include <algorithm>
#include <cmath>

#include "core/typed_volume.h"
#include "solver/speed/local_region_speed.h"
#include "solver/speed/region_sums.h"
#include "solver/speed/speed_kinds.h"

namespace tidemark::solver {
namespace {

// Means are rounded to about this part of their distance: voxels that flicker make no new function, and the
// function depends on phi alone, not on how the surface came there.
constexpr double kMeansStep = 1.0 / 1024.0;
// A larger box costs more than the global means.
constexpr std::int64_t kLongestReach = 32;  // voxels

// To multiples of a power of 2.
std::optional<RegionMeans> rounded(const std::optional<RegionMeans>& means) {
  if (!means || means->distance() == 0.0) return means;
  const double step = std::exp2(std::floor(std::log2(means->distance()))) * kMeansStep;
  return RegionMeans{std::round(means->inside / step) * step, std::round(means->outside / step) * step};
}

class RegionSpeed final : public SpeedFunction {
 public:
  explicit RegionSpeed(std::shared_ptr<const Volume> source)
      : source_(std::move(source)),
        sums_(std::make_shared<RegionSums>(source_, PageLayout(source_->geometry.size, kDefaultPageShape))) {}

  // D = ((I - c_out)^2 - (I - c_in)^2) / (c_in - c_out)^2, which is linear in I.
  void evaluate(const VoxelBox& box, double* speed) const override {
    with_type(*source_, [&](const auto& typed) {
      for (std::int64_t z = 0; z < box.size.z; ++z) {
        for (std::int64_t y = 0; y < box.size.y; ++y) {
          const std::int64_t row = typed.geometry.offset(box.first + Index3(0, y, z));
          for (std::int64_t x = 0; x < box.size.x; ++x) {
            *speed++ = std::clamp((static_cast<double>(typed.value(row + x)) - middle_) * slope_, -1.0, 1.0);
          }
        }
      }
    });
  }

  [[nodiscard]] bool follows_surface() const override { return true; }
  [[nodiscard]] std::shared_ptr<const SpeedFunction> following(const Field& phi) const override {
    const auto sums =
        phi.layout == sums_->layout() ? sums_ : std::make_shared<RegionSums>(source_, phi.layout);
    const std::optional<RegionMeans> means = rounded(sums->means(phi));
    if (means == means_) return nullptr;
    return std::make_shared<RegionSpeed>(source_, sums, means);
  }

  RegionSpeed(std::shared_ptr<const Volume> source, std::shared_ptr<const RegionSums> sums,
              std::optional<RegionMeans> means)
      : source_(std::move(source)), sums_(std::move(sums)), means_(means) {
    if (!means_) return;
    middle_ = 0.5 * (means_->inside + means_->outside);
    const double scale = std::max(std::abs(means_->inside), std::abs(means_->outside));
    if (means_->distance() > kEqual * scale) slope_ = 2.0 / (means_->inside - means_->outside);
  }

 private:
  // Means that differ by less, of their size, are equal but for rounding.
  static constexpr double kEqual = 1e-9;

  std::shared_ptr<const Volume> source_;
  std::shared_ptr<const RegionSums> sums_;
  std::optional<RegionMeans> means_;  // unset: there is no surface
  double middle_ = 0.0;
  double slope_ = 0.0;  // 0: nothing tells inside from outside
};

Result<std::shared_ptr<const SpeedFunction>> make_regions(const SpeedInputs& inputs,
                                                          const std::map<std::string, double>& values,
                                                          const Progress& /*progress*/) {
  const double radius = values.at("radius");
  if (radius == 0.0) return std::make_shared<RegionSpeed>(inputs.source);
  const Geometry& geometry = inputs.source->geometry;
  Index3 reach{0};
  for (int axis = 0; axis < 3; ++axis) {
    if (geometry.size[axis] == 1) continue;
    reach[axis] = std::max<std::int64_t>(1, std::llround(radius / geometry.spacing_mm[axis]));
    if (reach[axis] > kLongestReach) {
      return fail(ErrorKind::usage,
                  "the speed function regions: a radius of {} mm is above {} voxels; 0 is without end",
                  radius, kLongestReach);
    }
  }
  const auto [low, high] = inputs.source->common_range();
  return std::make_shared<LocalRegionSpeed>(inputs.source, reach, 0.5F * (low + high));
}

}  // namespace

const SpeedKind& regions_kind() {
  static const SpeedKind kind{
      .name = "regions",
      .title = "Regions",
      .text =
          "Grows where the brightness is nearer to the mean inside than to the mean outside, as they are "
          "now.",
      .follows_surface = true,
      .parameters = {{.name = "radius",
                      .title = "Radius",
                      .text = "How far around a voxel the means are taken, for a start that is about as near "
                              "to the border; 0 takes them from the whole volume.",
                      .unit = "mm",
                      .low = 0.0,
                      .high = 100.0,
                      .initial = 0.0}},
      .make = make_regions};
  return kind;
}

}  // namespace tidemark::solver
