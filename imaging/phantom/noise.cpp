#include "imaging/phantom/noise.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace tidemark::imaging::phantom {
namespace {

// The finalizer of SplitMix64 (Steele, Lea, Flood 2014): a bijection in which every input bit reaches every
// output bit.
std::uint64_t mix(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

constexpr std::uint64_t kGoldenRatio = 0x9e3779b97f4a7c15ULL;

// The four 16-bit numbers in a word, added up.
std::int64_t sum_of_quarters(std::uint64_t word) {
  return static_cast<std::int64_t>((word & 0xffff) + ((word >> 16) & 0xffff) + ((word >> 32) & 0xffff) +
                                   (word >> 48));
}

glm::dvec3 direction(std::uint64_t seed, std::uint64_t index) {
  const glm::dvec3 v(gaussian(seed, 3 * index), gaussian(seed, 3 * index + 1), gaussian(seed, 3 * index + 2));
  return v / std::sqrt(glm::dot(v, v) + 1e-12);
}

}  // namespace

std::uint64_t hash(std::uint64_t seed, std::uint64_t index) {
  return mix(mix(seed + kGoldenRatio) + (index + 1) * kGoldenRatio);
}

double uniform(std::uint64_t seed, std::uint64_t index) {
  return static_cast<double>(hash(seed, index) >> 11) * 0x1p-53;
}

double gaussian(std::uint64_t seed, std::uint64_t index) {
  // Eight uniform integers 0..65535: mean 4 * 65535, variance 8 * (65536^2 - 1) / 12.
  constexpr double kInverseDeviation = 1.0 / 53509.92;
  const std::int64_t sum =
      sum_of_quarters(hash(seed, 2 * index)) + sum_of_quarters(hash(seed, 2 * index + 1));
  return static_cast<double>(sum - 4 * 65535) * kInverseDeviation;
}

Wave wave(double turns) {
  // To the nearest turn, then to the quarters around 0 where the series of sine converges fast.
  double t = turns - static_cast<double>(static_cast<std::int64_t>(turns + (turns < 0 ? -0.5 : 0.5)));
  double sign = 1.0;
  if (t > 0.25 || t < -0.25) {
    t = (t > 0 ? 0.5 : -0.5) - t;
    sign = -1.0;
  }
  constexpr double kTwoPi = 6.283185307179586;
  const double x = kTwoPi * t;
  const double s = x * x;
  const double sine = x * (1 - s / 6 * (1 - s / 20 * (1 - s / 42 * (1 - s / 72))));
  const double cosine = 1 - s / 2 * (1 - s / 12 * (1 - s / 30 * (1 - s / 56 * (1 - s / 90))));
  return {sine, kTwoPi * sign * cosine};
}

RandomWaves::RandomWaves(std::uint64_t seed, int waves, double shortest_mm, double longest_mm)
    : amplitude_(std::sqrt(2.0 / waves)) {
  for (int i = 0; i < waves; ++i) {
    const auto index = static_cast<std::uint64_t>(i);
    const double length = shortest_mm + (longest_mm - shortest_mm) * uniform(hash(seed, 1), index);
    components_.push_back({direction(hash(seed, 2), index) / length, uniform(hash(seed, 3), index)});
  }
}

RandomWaves::Sample RandomWaves::sample(const glm::dvec3& p_mm) const {
  Sample sum{0.0, glm::dvec3(0.0)};
  for (const Component& component : components_) {
    const Wave w = wave(glm::dot(component.turns_per_mm, p_mm) + component.phase);
    sum.value += w.value;
    sum.gradient += w.slope * component.turns_per_mm;
  }
  return {amplitude_ * sum.value, amplitude_ * sum.gradient};
}

double RandomWaves::value(const glm::dvec3& p_mm) const {
  double sum = 0.0;
  for (const Component& component : components_) {
    sum += wave(glm::dot(component.turns_per_mm, p_mm) + component.phase).value;
  }
  return amplitude_ * sum;
}

}  // namespace tidemark::imaging::phantom
