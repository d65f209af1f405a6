#include "imaging/phantom/noise.h"

#include <algorithm>
#include <cassert>
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

constexpr double kTwoPi = 6.283185307179586;

// An angle between two turns: the distance from the nearest half turn (within a quarter), with the angle's
// sign, in radians, where the series below converge fast; and whether that half turn is an odd one.
struct Angle {
  double from_half_turn;
  bool odd;
};

// Without a branch and without an integer, so that several waves fit one instruction.
Angle angle(double turns) {
  constexpr double kRounds = 0x1.8p52;  // a number of this size has no digits after the point
  const double turn = turns - ((turns + kRounds) - kRounds);
  const double distance = std::abs(turn);
  return {kTwoPi * std::copysign(std::min(distance, 0.5 - distance), turn), distance > 0.25};
}

// The Taylor series of both, by Horner's scheme.
double sine(const Angle& angle) {
  const double x = angle.from_half_turn;
  const double s = x * x;
  return x * (1.0 + s * (-1.0 / 6 + s * (1.0 / 120 + s * (-1.0 / 5040 + s * (1.0 / 362880)))));
}
double cosine(const Angle& angle) {
  const double s = angle.from_half_turn * angle.from_half_turn;
  const double near =
      1.0 + s * (-1.0 / 2 + s * (1.0 / 24 + s * (-1.0 / 720 + s * (1.0 / 40320 + s * (-1.0 / 3628800)))));
  return angle.odd ? -near : near;
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
  const Angle a = angle(turns);
  return {sine(a), kTwoPi * cosine(a)};
}

RandomWaves::RandomWaves(std::uint64_t seed, int waves, double shortest_mm, double longest_mm)
    : count_(static_cast<std::size_t>(waves)), amplitude_(std::sqrt(2.0 / waves)) {
  assert(count_ <= kMost);
  for (std::size_t i = 0; i < count_; ++i) {
    const double length = shortest_mm + (longest_mm - shortest_mm) * uniform(hash(seed, 1), i);
    const glm::dvec3 turns_per_mm = direction(hash(seed, 2), i) / length;
    x_[i] = turns_per_mm.x;
    y_[i] = turns_per_mm.y;
    z_[i] = turns_per_mm.z;
    phase_[i] = uniform(hash(seed, 3), i);
  }
}

RandomWaves::Sample RandomWaves::sample(const glm::dvec3& p_mm) const {
  std::array<double, kMost> values;
  std::array<double, kMost> slopes;
  for (std::size_t i = 0; i < count_; ++i) {
    const Wave w = wave(turns(i, p_mm));
    values[i] = w.value;
    slopes[i] = w.slope;
  }
  Sample sum{0.0, glm::dvec3(0.0)};
  for (std::size_t i = 0; i < count_; ++i) {
    sum.value += values[i];
    sum.gradient += slopes[i] * glm::dvec3(x_[i], y_[i], z_[i]);
  }
  return {amplitude_ * sum.value, amplitude_ * sum.gradient};
}

double RandomWaves::value(const glm::dvec3& p_mm) const {
  std::array<double, kMost> values;
  for (std::size_t i = 0; i < count_; ++i) values[i] = sine(angle(turns(i, p_mm)));
  double sum = 0.0;
  for (std::size_t i = 0; i < count_; ++i) sum += values[i];
  return amplitude_ * sum;
}

}  // namespace tidemark::imaging::phantom
