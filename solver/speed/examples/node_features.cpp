#include "solver/speed/examples/node_features.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace tidemark::solver {
namespace {

// The elements of a symmetric matrix.
enum Element { xx, yy, zz, xy, xz, yz, kElements };

struct Eigenvalues {
  float largest;
  float middle;
  float smallest;
};

// The power of two at or below a number of 0 or more, and at least the least normal number.
inline float power_of_two(float number) {
  constexpr std::uint32_t kExponent = 0x7F800000U;
  const float power = std::bit_cast<float>(std::bit_cast<std::uint32_t>(number) & kExponent);
  return std::max(power, std::numeric_limits<float>::min());
}

// In closed form: with q the mean and p the deviation of the eigenvalues they are q + 2 p cos(a) for three
// angles a = acos(r) / 3 + 2 pi n / 3. Its cosine and sine are polynomials of s = cos(acos(r) / 2), right to
// 1e-5, so that the result has the same bits with every library of mathematics. The elements less q are taken
// in a unit near the largest of them: p to the third fits into a float for images of any unit.
inline Eigenvalues eigenvalues(float a, float b, float c, float d, float e, float f) {
  const float q = (a + b + c) * (1.0F / 3.0F);
  const float across = std::max(std::abs(d), std::max(std::abs(e), std::abs(f)));
  const float along = std::max(std::abs(a - q), std::max(std::abs(b - q), std::abs(c - q)));
  const float unit = power_of_two(std::max(along, across));
  const float scale = 1.0F / unit;
  const float x = (a - q) * scale;
  const float y = (b - q) * scale;
  const float z = (c - q) * scale;
  d *= scale;
  e *= scale;
  f *= scale;
  const float squares = (x * x + y * y + z * z) + 2.0F * (d * d + e * e + f * f);
  const float p = std::sqrt(squares * (1.0F / 6.0F));
  const float determinant = x * (y * z - f * f) - d * (d * z - f * e) + e * (d * f - y * e);
  const float r = determinant / (2.0F * p * p * p + 1e-30F);  // 0 where all are 0
  const float half = std::min(std::max(0.5F + 0.5F * r, 0.0F), 1.0F);
  const float s = std::sqrt(half);
  const float cosine = 0.5000106F + s * (0.5768125F + s * (-0.1064940F + s * (0.0383529F - s * 0.0086884F)));
  const float sine = std::sqrt(1.0F - s) *
                     (0.8660293F + s * (0.0994833F + s * (-0.0326710F + s * (0.0130074F - s * 0.0030422F))));
  const float spread = p * unit;
  const float largest = q + 2.0F * spread * cosine;
  const float smallest = q - spread * (cosine + 1.7320508F * sine);
  return {largest, 3.0F * q - largest - smallest, smallest};
}

struct Layout {
  std::int64_t y;  // from a node to the next along y
  std::int64_t z;  // and along z
  std::int64_t nodes;
};

// Calls run(begin, end) for the nodes that are read: slice by slice, from the first of these to the last.
// What is costly is computed there alone.
template <class Run>
void for_each_run(Index3 size, const Layout& at, const Run& run) {
  const std::int64_t first = kFeatureReach * (at.y + 1);
  const std::int64_t last = (size.y - 1 - kFeatureReach) * at.y + size.x - 1 - kFeatureReach;
  for (std::int64_t z = kFeatureReach; z < size.z - kFeatureReach; ++z)
    run(z * at.z + first, z * at.z + last + 1);
}

// All of this runs over whole arrays. What it takes across the ends of rows ends up in the reach.
std::vector<float> gradient_products(const std::vector<float>& mean, const Layout& at, glm::vec3 half,
                                     float* magnitude) {
  std::vector<float> products(static_cast<std::size_t>(kElements * at.nodes), 0.0F);
  const float* v = mean.data();
  float* p = products.data();
  for (std::int64_t i = at.z; i < at.nodes - at.z; ++i) {
    const float x = (v[i + 1] - v[i - 1]) * half.x;
    const float y = (v[i + at.y] - v[i - at.y]) * half.y;
    const float z = (v[i + at.z] - v[i - at.z]) * half.z;
    p[xx * at.nodes + i] = x * x;
    p[yy * at.nodes + i] = y * y;
    p[zz * at.nodes + i] = z * z;
    p[xy * at.nodes + i] = x * y;
    p[xz * at.nodes + i] = x * z;
    p[yz * at.nodes + i] = y * z;
    magnitude[i] = std::sqrt(x * x + y * y + z * z);
  }
  return products;
}

// Weights 1/4, 1/2, 1/4 along each axis.
void smooth(float* values, float* scratch, const Layout& at) {
  const auto along = [&](const float* from, float* to, std::int64_t stride) {
    for (std::int64_t i = at.z; i < at.nodes - at.z; ++i) {
      to[i] = 0.5F * from[i] + 0.25F * (from[i - stride] + from[i + stride]);
    }
  };
  along(values, scratch, 1);
  along(scratch, values, at.y);
  along(values, scratch, at.z);
  std::copy(scratch, scratch + at.nodes, values);
}

void hessian_features(const std::vector<float>& mean, const Layout& at, std::int64_t begin, std::int64_t end,
                      glm::vec3 inverse, float* largest, float* middle, float* smallest) {
  const float* v = mean.data();
  const glm::vec3 twice = inverse * inverse;
  const float mixed_xy = 0.25F * inverse.x * inverse.y;
  const float mixed_xz = 0.25F * inverse.x * inverse.z;
  const float mixed_yz = 0.25F * inverse.y * inverse.z;
  for (std::int64_t i = begin; i < end; ++i) {
    const float two = 2.0F * v[i];
    const auto mixed = [&](std::int64_t a, std::int64_t b) {
      return (v[i + a + b] - v[i + a - b]) - (v[i - a + b] - v[i - a - b]);
    };
    const Eigenvalues e =
        eigenvalues((v[i + 1] + v[i - 1] - two) * twice.x, (v[i + at.y] + v[i - at.y] - two) * twice.y,
                    (v[i + at.z] + v[i - at.z] - two) * twice.z, mixed(1, at.y) * mixed_xy,
                    mixed(1, at.z) * mixed_xz, mixed(at.y, at.z) * mixed_yz);
    largest[i] = e.largest;
    middle[i] = e.middle;
    smallest[i] = e.smallest;
  }
}

}  // namespace

void node_features(const Moments& moments, glm::dvec3 step_mm, std::vector<float>& features) {
  const Index3 size = moments.box.size;
  const Layout at{size.x, size.x * size.y, moments.box.voxels()};
  const glm::vec3 inverse(1.0 / step_mm);
  features.assign(static_cast<std::size_t>(kNodeFeatures * at.nodes), 0.0F);
  const auto array = [&](NodeFeature feature) { return features.data() + feature * at.nodes; };

  std::copy(moments.mean.begin(), moments.mean.end(), array(value));
  float* deviations = array(deviation);
  const float* means = moments.mean.data();
  const float* squares = moments.square.data();
  for_each_run(size, at, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i < end; ++i)
      deviations[i] = std::sqrt(std::max(squares[i] - means[i] * means[i], 0.0F));
  });

  std::vector<float> products = gradient_products(moments.mean, at, 0.5F * inverse, array(gradient));
  std::vector<float> scratch(static_cast<std::size_t>(at.nodes), 0.0F);
  for (int element = 0; element < kElements; ++element) {
    smooth(products.data() + element * at.nodes, scratch.data(), at);
  }
  for_each_run(size, at, [&](std::int64_t begin, std::int64_t end) {
    hessian_features(moments.mean, at, begin, end, inverse, array(hessian_largest), array(hessian_middle),
                     array(hessian_smallest));
  });

  const float* p = products.data();
  float* largest = array(structure_largest);
  float* middle = array(structure_middle);
  float* smallest = array(structure_smallest);
  for_each_run(size, at, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i < end; ++i) {
      const auto element = [&](Element e) { return p[e * at.nodes + i]; };
      const Eigenvalues e =
          eigenvalues(element(xx), element(yy), element(zz), element(xy), element(xz), element(yz));
      largest[i] = std::sqrt(std::max(e.largest, 0.0F));
      middle[i] = std::sqrt(std::max(e.middle, 0.0F));
      smallest[i] = std::sqrt(std::max(e.smallest, 0.0F));
    }
  });
}

}  // namespace tidemark::solver
