// Growth that edges stop: D = balloon g with g = 1 / (1 + (|grad G_sigma * I| / K)^2), and the velocity
// -attraction grad g, which draws the surface to edges (Caselles, Kimmel and Sapiro, "Geodesic Active
// Contours", 1997).
//
// At an edge, where g < 1/2, the velocity is -attraction grad g / 2 g. There g is about (K / |grad|)^2, so
// that grad g fades with it, and the curvature of a small object, which does not fade, would hold the surface
// 1 to 3 sigma inside of a strong edge. In units of sigma, grad g / 2 g is the distance to the edge, however
// strong the edge is: the surface stops (1 - alpha) kappa sigma^2 inside of it.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/common.hpp>

#include "solver/speed/block.h"
#include "solver/speed/speed_kinds.h"

namespace tidemark::solver {
namespace {

// K, unless it is told, is so many times the gradient that noise and texture have.
constexpr double kAboveNoise = 1.5;
// A Gaussian that reaches farther costs more than it shows.
constexpr double kLargestSigma = 16.0;  // voxels

// Central differences of the voxel at `i` of a block, by the distances given.
glm::vec3 gradient(const Block& block, std::int64_t i, glm::vec3 inverse_distances) {
  const Index3 size = block.box.size;
  const float* centre = block.values.data() + i;
  const std::int64_t slice = size.x * size.y;
  return glm::vec3(centre[1] - centre[-1], centre[size.x] - centre[-size.x], centre[slice] - centre[-slice]) *
         inverse_distances;
}

// Calls visit(index in the block) for the voxels of the block without a layer of one, x fastest.
template <class Visit>
void for_inner_voxels(const Block& block, const Visit& visit) {
  const Index3 size = block.box.size;
  for (std::int64_t z = 1; z < size.z - 1; ++z) {
    for (std::int64_t y = 1; y < size.y - 1; ++y) {
      const std::int64_t row = number_in(size, Index3(0, y, z));
      for (std::int64_t x = 1; x < size.x - 1; ++x) visit(row + x);
    }
  }
}

class SmoothedGradient {
 public:
  SmoothedGradient(std::shared_ptr<const Volume> source, double sigma_mm)
      : source_(std::move(source)),
        weights_(gaussian_weights(source_->geometry, sigma_mm)),
        inverse_distances_(0.5 / source_->geometry.spacing_mm) {}

  // |grad G_sigma * I|^2 in the box, in source units per mm.
  [[nodiscard]] Block squared(const VoxelBox& box) const {
    const VoxelBox around = grown(box, Index3(1));
    Block smoothed = values_in(*source_, grown(around, reach_of(weights_)));
    sum_along_axes(smoothed, weights_);
    Block squares{box, {}};
    squares.values.reserve(static_cast<std::size_t>(box.voxels()));
    for_inner_voxels(smoothed, [&](std::int64_t i) {
      const glm::vec3 g = gradient(smoothed, i, inverse_distances_);
      squares.values.push_back(g.x * g.x + g.y * g.y + g.z * g.z);
    });
    return squares;
  }

  // The median of all magnitudes that are not 0, from a regular sample: what noise and texture have; 1 where
  // the source is constant.
  [[nodiscard]] double median() const {
    constexpr Index3 kSample{8};
    constexpr std::int64_t kSamplesAnAxis = 8;
    const Index3 size = source_->geometry.size;
    const Index3 shape = glm::min(size, kSample);
    const Index3 samples = glm::clamp(size / shape, Index3(1), Index3(kSamplesAnAxis));
    std::vector<float> all;
    for (std::int64_t i = 0; i < samples.x * samples.y * samples.z; ++i) {
      const Index3 at(i % samples.x, i / samples.x % samples.y, i / (samples.x * samples.y));
      const Index3 middle = size * (at + at + Index3(1)) / (samples + samples);
      const Block squares =
          squared({glm::clamp(middle - shape / std::int64_t{2}, Index3(0), size - shape), shape});
      std::copy_if(squares.values.begin(), squares.values.end(), std::back_inserter(all),
                   [](float square) { return square > 0.0F; });
    }
    if (all.empty()) return 1.0;
    const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
    std::nth_element(all.begin(), middle, all.end());
    return std::sqrt(static_cast<double>(*middle));
  }

  [[nodiscard]] const Geometry& geometry() const { return source_->geometry; }

 private:
  std::shared_ptr<const Volume> source_;
  AxisWeights weights_;
  glm::vec3 inverse_distances_;
};

class EdgeSpeed final : public SpeedFunction {
 public:
  EdgeSpeed(SmoothedGradient gradient, double contrast, double balloon, double attraction)
      : gradient_(std::move(gradient)),
        inverse_squared_contrast_(static_cast<float>(1.0 / (contrast * contrast))),
        balloon_(balloon),
        attraction_(attraction) {}

  void evaluate(const VoxelBox& box, double* speed) const override {
    const Block g = stopping(box);
    std::transform(g.values.begin(), g.values.end(), speed,
                   [&](float value) { return balloon_ * static_cast<double>(value); });
  }

  [[nodiscard]] bool advects() const override { return attraction_ != 0.0; }
  void evaluate_advection(const VoxelBox& box, glm::vec3* velocity) const override {
    const Block g = stopping(grown(box, Index3(1)));
    const glm::dvec3 spacing = gradient_.geometry().spacing_mm;
    const double smallest = std::min({spacing.x, spacing.y, spacing.z});
    const glm::vec3 factors(-attraction_ * 0.5 * smallest / spacing);
    const auto limit = static_cast<float>(0.5 * attraction_);
    for_inner_voxels(g, [&](std::int64_t i) {
      const float at_edge = std::max(1.0F, 0.5F / g.values[static_cast<std::size_t>(i)]);
      *velocity++ = glm::clamp(gradient(g, i, factors) * at_edge, -limit, limit);
    });
  }
  // As far as g in (0, 1] can differ between neighbours: its central differences are below 1/2.
  [[nodiscard]] double fastest_advection() const override { return attraction_ * 0.5 * std::numbers::sqrt3; }

 private:
  [[nodiscard]] Block stopping(const VoxelBox& box) const {
    Block g = gradient_.squared(box);
    for (float& value : g.values) value = 1.0F / (1.0F + value * inverse_squared_contrast_);
    return g;
  }

  SmoothedGradient gradient_;
  float inverse_squared_contrast_;
  double balloon_;
  double attraction_;
};

Result<std::shared_ptr<const SpeedFunction>> make_edges(const SpeedInputs& inputs,
                                                        const std::map<std::string, double>& values,
                                                        const Progress& /*progress*/) {
  const double sigma = values.at("sigma");
  const glm::dvec3 spacing = inputs.source->geometry.spacing_mm;
  const double smallest = std::min({spacing.x, spacing.y, spacing.z});
  if (sigma > kLargestSigma * smallest) {
    return fail(ErrorKind::usage,
                "the speed function edges: sigma of {} mm is above {} voxels, which are {} mm here", sigma,
                kLargestSigma, kLargestSigma * smallest);
  }
  SmoothedGradient gradient(inputs.source, sigma);
  const double contrast = values.at("contrast");
  const double used = contrast > 0.0 ? contrast : kAboveNoise * gradient.median();
  return std::make_shared<EdgeSpeed>(std::move(gradient), used, values.at("balloon"),
                                     values.at("attraction"));
}

}  // namespace

const SpeedKind& edges_kind() {
  static const SpeedKind kind{
      .name = "edges",
      .title = "Edges",
      .text =
          "Grows or shrinks as the balloon force says, slower where the brightness changes, and is drawn to "
          "edges.",
      .parameters =
          {{.name = "sigma",
            .title = "Smoothing",
            .text = "The standard deviation of the Gaussian before the gradient is taken.",
            .unit = "mm",
            .low = 0.0,
            .high = 10.0,
            .initial = 1.0},
           {.name = "contrast",
            .title = "Contrast",
            .text = "K: the change of brightness per mm that halves the speed; 0 takes it from the image.",
            .unit = "1/mm",
            .low = 0.0,
            .high = 1e6,
            .initial = 0.0},
           {.name = "balloon",
            .title = "Balloon force",
            .text = "The speed away from edges: above 0 the surface grows, below 0 it shrinks.",
            .unit = "",
            .low = -1.0,
            .high = 1.0,
            .initial = 1.0},
           {.name = "attraction",
            .title = "Attraction",
            .text = "How fast edges nearby draw the surface to them.",
            .unit = "",
            .low = 0.0,
            .high = 10.0,
            .initial = 1.0}},
      .make = make_edges};
  return kind;
}

}  // namespace tidemark::solver
