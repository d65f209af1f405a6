#include "renderer/host/shade_pieces.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

// This file is compiled once for each of these instruction sets; the best one is chosen when the program
// runs.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "renderer/host/shade_pieces.cpp"
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL)
#include "hwy/foreach_target.h"  // before highway.h

#include "hwy/contrib/math/math-inl.h"
#include "hwy/highway.h"
#include "renderer/host/source_sampler-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tidemark::renderer::HWY_NAMESPACE {
namespace {

// Abramowitz and Stegun 7.1.28, to 3e-7.
HWY_INLINE V error_function(V x) {
  const V a = hn::Abs(x);
  V d = set(0.0000430638F);
  for (const float factor :
       {0.0002765672F, 0.0001520143F, 0.0092705272F, 0.0422820123F, 0.0705230784F, 1.0F}) {
    d = hn::MulAdd(d, a, set(factor));
  }
  for (int i = 0; i < 4; ++i) d = hn::Mul(d, d);
  return hn::CopySign(hn::Sub(set(1.0F), hn::Div(set(1.0F), d)), x);
}

HWY_INLINE V factor(const PieceScene::Factor& shape, V x) {
  switch (shape.kind) {
    case TransferFactor::Kind::ramp: {
      const V u = hn::Mul(hn::Sub(x, set(shape.start)), set(1.0F / (shape.end - shape.start)));
      return hn::Min(hn::Max(u, hn::Zero(Tag())), set(1.0F));
    }
    case TransferFactor::Kind::gaussian: {
      const V u = hn::Mul(hn::Sub(x, set(shape.start)), set(1.0F / shape.end));
      return hn::Exp(Tag(), hn::Neg(hn::Mul(u, u)));
    }
    case TransferFactor::Kind::everything:
      break;
  }
  return set(1.0F);
}

// The ramp's integral from 0.
HWY_INLINE V ramp_integral(V x) {
  const V one = set(1.0F);
  const V c = hn::Min(hn::Max(x, hn::Zero(Tag())), one);
  return hn::MulAdd(hn::Mul(set(0.5F), c), c, hn::Max(hn::Sub(x, one), hn::Zero(Tag())));
}

// A factor's integral, in units of its width.
HWY_INLINE V integral(const PieceScene::Factor& shape, V u) {
  if (shape.kind == TransferFactor::Kind::ramp) return ramp_integral(u);
  return hn::Mul(set(0.88622693F), error_function(u));  // sqrt(pi) / 2
}

// The lanes moved up by one; `first` comes below them. They stay in registers: a load of what was just stored
// would wait.
HWY_INLINE V move_up(float first, V lanes) {
  alignas(64) static constexpr std::int32_t kFrom[16] = {0, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14};
  static_assert(kLanes <= 16);
  const V up = hn::TableLookupLanes(lanes, hn::SetTableIndices(Tag(), kFrom));
  return hn::IfThenElse(hn::FirstN(Tag(), 1), set(first), up);
}
HWY_INLINE float last_of(V lanes) {
  return hn::ExtractLane(lanes, kLanes - 1);
}

struct Material {
  V red, green, blue;  // times opacity
  V opacity;           // of a mm
};

// The mean of a factor while the value goes evenly from a to b: no step is too long for a thin Gaussian.
// `inverse`: of b - a. `before`: the integral where the first lane's piece begins; then, where the last one's
// ends.
HWY_INLINE V mean_factor(const PieceScene::Factor& shape, V a, V b, V inverse, float& before) {
  if (shape.kind == TransferFactor::Kind::everything) return set(1.0F);
  const bool gaussian = shape.kind == TransferFactor::Kind::gaussian;
  const float width = gaussian ? shape.end : shape.end - shape.start;
  const V after = integral(shape, hn::Mul(hn::Sub(b, set(shape.start)), set(1.0F / width)));
  const auto short_way = hn::Lt(hn::Abs(hn::Sub(b, a)), set(0.1F * std::abs(width)));
  V mean = hn::Mul(hn::Mul(hn::Sub(after, move_up(before, after)), set(width)), inverse);
  before = last_of(after);
  if (!hn::AllFalse(Tag(), short_way)) {
    mean = hn::IfThenElse(short_way, factor(shape, hn::Mul(set(0.5F), hn::Add(a, b))), mean);
  }
  return mean;
}

// Of each primitive while the value goes from a to b; all but the gradient's factor.
using Shares = V[TransferFunction::kMostPrimitives];
HWY_INLINE V shares_of(const PieceScene& scene, V a, V b, V phi, Pieces::Integrals& integrals,
                       Shares& shares) {
  V sum = hn::Zero(Tag());
  const V inverse = hn::Div(set(1.0F), hn::Sub(b, a));
  for (int i = 0; i < scene.count; ++i) {
    const PieceScene::Primitive& one = scene.primitives[static_cast<std::size_t>(i)];
    shares[i] = hn::Mul(set(one.opacity),
                        mean_factor(one.value, a, b, inverse, integrals[static_cast<std::size_t>(i)]));
    if (one.phi.kind != TransferFactor::Kind::everything)
      shares[i] = hn::Mul(shares[i], factor(one.phi, phi));
    sum = hn::Add(sum, shares[i]);
  }
  return sum;
}

HWY_INLINE Material classify(const PieceScene& scene, const Shares& shares, V gradient) {
  const V zero = hn::Zero(Tag());
  Material sum{zero, zero, zero, zero};
  for (int i = 0; i < scene.count; ++i) {
    const PieceScene::Primitive& one = scene.primitives[static_cast<std::size_t>(i)];
    V share = shares[i];
    if (one.gradient.kind != TransferFactor::Kind::everything)
      share = hn::Mul(share, factor(one.gradient, gradient));
    sum.red = hn::MulAdd(share, set(one.colour.r), sum.red);
    sum.green = hn::MulAdd(share, set(one.colour.g), sum.green);
    sum.blue = hn::MulAdd(share, set(one.colour.b), sum.blue);
    sum.opacity = hn::Add(sum.opacity, share);
  }
  return sum;
}

// How much of pieces with these phi at their ends the region lets through.
HWY_INLINE V share_in_region(Region region, V phi_a, V phi_b) {
  const V one = set(1.0F);
  const V zero = hn::Zero(Tag());
  const auto in_a = hn::Gt(phi_a, zero);
  const auto in_b = hn::Gt(phi_b, zero);
  const V crossed = hn::Div(hn::Max(phi_a, phi_b), hn::Max(hn::Abs(hn::Sub(phi_a, phi_b)), set(1e-30F)));
  const V whole = hn::IfThenElse(in_a, one, zero);
  const V inside = hn::IfThenElse(hn::Xor(in_a, in_b), crossed, whole);
  return region == Region::inside ? inside : hn::Sub(one, inside);
}

HWY_INLINE Place place_at(const PieceScene& scene, const Pieces& pieces, V along) {
  return {hn::MulAdd(along, set(scene.direction.x), set(pieces.start.x)),
          hn::MulAdd(along, set(scene.direction.y), set(pieces.start.y)),
          hn::MulAdd(along, set(scene.direction.z), set(pieces.start.z))};
}

HWY_INLINE V dot(const Place& a, const glm::vec3& b) {
  return hn::MulAdd(a.z, set(b.z), hn::MulAdd(a.y, set(b.y), hn::Mul(a.x, set(b.x))));
}

// For x from 0 to 1; 0 where x is below the least that matters.
HWY_INLINE V to_shininess(const PieceScene& scene, V x) {
  const auto matters = hn::Ge(x, set(scene.least_mirrored));
  if (hn::AllFalse(Tag(), matters)) return hn::Zero(Tag());
  x = hn::IfThenElseZero(matters, x);
  int exponent = static_cast<int>(scene.shininess);
  if (static_cast<float>(exponent) != scene.shininess) {
    return hn::Exp(Tag(), hn::Mul(set(scene.shininess), hn::Log(Tag(), hn::Max(x, set(1e-20F)))));
  }
  V power = set(1.0F);
  for (; exponent > 0; exponent >>= 1) {
    if ((exponent & 1) != 0) power = hn::Mul(power, x);
    x = hn::Mul(x, x);
  }
  return power;
}

// Blinn-Phong, two-sided: what a colour is multiplied by, and what is added to it.
HWY_INLINE void light(const PieceScene& scene, const Place& gradient, V steepness, V& factor, V& gloss) {
  const auto flat = hn::Lt(steepness, set(1e-30F));
  const V inverse = hn::Div(set(1.0F), hn::Max(steepness, set(1e-30F)));
  const V facing = hn::Mul(hn::Abs(dot(gradient, scene.light)), inverse);
  factor = hn::IfThenElse(flat, set(1.0F), hn::MulAdd(set(scene.diffuse), facing, set(scene.ambient)));
  gloss = hn::Zero(Tag());
  if (scene.specular <= 0.0F) return;
  const V mirrored = hn::Mul(hn::Abs(dot(gradient, scene.half_way)), inverse);
  gloss = hn::IfThenElse(flat, gloss, hn::Mul(set(scene.specular), to_shininess(scene, mirrored)));
}

struct Shaded {
  alignas(64) float red[kLanes], green[kLanes], blue[kLanes], transparency[kLanes];
};

// Lanes from `first` on, with the values where their pieces begin and end, and the slope there. Returns false
// when nothing shows in them.
template <class T>
HWY_INLINE bool shade_lanes(const PieceScene& scene, Pieces& pieces, const Sampler<T>& sampler, int first,
                            V end, V a, V b, const Place& cell_slope, Shaded& shaded) {
  const Tag d;
  const V begin = hn::LoadU(d, pieces.from.data() + first);
  const V phi_b = hn::LoadU(d, pieces.phi.data() + first + 1);
  const V phi_a = move_up(pieces.phi[static_cast<std::size_t>(first)], phi_b);
  V length = hn::Sub(hn::Min(end, set(pieces.shows_to)), hn::Max(begin, set(pieces.shows_from)));
  length = hn::Mul(hn::Max(length, hn::Zero(d)), set(scene.mm));
  if (scene.region == Region::inside || scene.region == Region::outside) {
    length = hn::Mul(length, share_in_region(scene.region, phi_a, phi_b));
  }
  const V phi = hn::Mul(set(0.5F), hn::Add(phi_a, phi_b));
  Shares shares;
  const auto shows = [&](V opacity) HWY_ATTR { return hn::Gt(hn::Mul(opacity, length), set(kLeastOpacity)); };
  const auto may_show = shows(shares_of(scene, a, b, phi, pieces.integrals, shares));
  if (hn::AllFalse(d, may_show)) return false;

  Place gradient = cell_slope;
  if (!scene.fast_gradient) {
    const V middle = hn::Mul(set(0.5F), hn::Add(begin, end));
    gradient = sampler.central_slope(place_at(scene, pieces, middle), may_show);
  }
  const float slope = scene.source->slope();
  gradient.x = hn::Mul(gradient.x, set(slope * scene.inverse_spacing.x));
  gradient.y = hn::Mul(gradient.y, set(slope * scene.inverse_spacing.y));
  gradient.z = hn::Mul(gradient.z, set(slope * scene.inverse_spacing.z));
  const V squared =
      hn::MulAdd(gradient.z, gradient.z, hn::MulAdd(gradient.y, gradient.y, hn::Mul(gradient.x, gradient.x)));
  const V steepness = hn::Sqrt(squared);
  const Material material = classify(scene, shares, steepness);
  const auto seen = shows(material.opacity);
  if (hn::AllFalse(d, seen)) return false;
  const V inverse = hn::Div(set(1.0F), hn::Max(material.opacity, set(1e-30F)));
  const V transparency =
      hn::IfThenElse(seen, hn::Exp(d, hn::Neg(hn::Mul(material.opacity, length))), set(1.0F));
  const V opacity = hn::Sub(set(1.0F), transparency);
  V red = hn::Mul(material.red, inverse);
  V green = hn::Mul(material.green, inverse);
  V blue = hn::Mul(material.blue, inverse);
  if (scene.region == Region::tinted) {
    const V share = hn::IfThenElseZero(hn::Gt(phi_b, hn::Zero(d)), set(0.7F));
    red = mix(red, set(scene.tint.r), share);
    green = mix(green, set(scene.tint.g), share);
    blue = mix(blue, set(scene.tint.b), share);
  }
  V lit;
  V gloss;
  light(scene, gradient, steepness, lit, gloss);
  hn::Store(hn::Mul(opacity, hn::MulAdd(red, lit, gloss)), d, shaded.red);
  hn::Store(hn::Mul(opacity, hn::MulAdd(green, lit, gloss)), d, shaded.green);
  hn::Store(hn::Mul(opacity, hn::MulAdd(blue, lit, gloss)), d, shaded.blue);
  hn::Store(transparency, d, shaded.transparency);
  return true;
}

template <class T>
HWY_INLINE void shade(const PieceScene& scene, Pieces& pieces, glm::vec4& result) {
  const Tag d;
  static_assert(Pieces::kMost % kLanes == 0);
  const auto z_at = [&](std::size_t piece) { return pieces.start.z + pieces.to[piece] * scene.direction.z; };
  const auto count = static_cast<std::size_t>(pieces.count);
  const Sampler<T> sampler(*scene.source, z_at(0), z_at(count - 1));
  // What is behind the last piece is a gap, but lanes of it are computed.
  std::fill(pieces.from.begin() + pieces.count, pieces.from.end(), pieces.to[count - 1]);
  std::fill(pieces.to.begin() + pieces.count, pieces.to.end(), pieces.to[count - 1]);
  std::fill(pieces.phi.begin() + pieces.count + 1, pieces.phi.end(), pieces.phi[count]);
  Shaded shaded;
  // The sums stay in registers: in memory each would wait for the one before.
  float red = result.r, green = result.g, blue = result.b;
  float left = 1.0F - result.a;
  for (int first = 0; first < pieces.count; first += kLanes) {
    const V end = hn::LoadU(d, pieces.to.data() + first);
    const Place place = place_at(scene, pieces, end);
    if (scene.rays_are_sparse) {
      const auto begin = static_cast<std::size_t>(first);
      const float length = pieces.to[begin + kLanes - 1] - pieces.from[begin];
      sampler.ask_for(sampler.cell(place_at(scene, pieces, hn::Add(end, set(length)))));
    }
    Place slope{};
    const auto cell = sampler.cell(place);
    const V stored = scene.fast_gradient ? sampler.value(cell, slope) : sampler.value(cell);
    const V b = hn::MulAdd(stored, set(scene.source->slope()), set(scene.source->intercept()));
    const V a = move_up(pieces.value, b);
    pieces.value = last_of(b);
    if (!shade_lanes(scene, pieces, sampler, first, end, a, b, slope, shaded)) continue;
    const int lanes = std::min(pieces.count - first, kLanes);
    for (int i = 0; i < lanes && 1.0F - left < kOpaque; ++i) {
      red += left * shaded.red[i];
      green += left * shaded.green[i];
      blue += left * shaded.blue[i];
      left *= shaded.transparency[i];
    }
    if (1.0F - left >= kOpaque) break;
  }
  result = {red, green, blue, 1.0F - left};
  pieces.phi[0] = pieces.phi[count];
  pieces.count = 0;
}

}  // namespace

void shade_any(const PieceScene& scene, Pieces& pieces, glm::vec4& result) {
  switch (scene.source->stored()) {
    case SourceSamples::Stored::int16:
      return shade<std::int16_t>(scene, pieces, result);
    case SourceSamples::Stored::uint16:
      return shade<std::uint16_t>(scene, pieces, result);
    case SourceSamples::Stored::float32:
      return shade<float>(scene, pieces, result);
  }
}

ShadePieces shader() {
  return shade_any;
}

}  // namespace tidemark::renderer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tidemark::renderer {
namespace {

HWY_EXPORT(shader);

}  // namespace

ShadePieces shade_pieces() {
  return HWY_DYNAMIC_DISPATCH(shader)();
}

}  // namespace tidemark::renderer
#endif  // HWY_ONCE
