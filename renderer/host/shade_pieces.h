// The light of pieces of a ray that pass through the source: the inner loop of volume renderings, in lanes.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "renderer/host/source_samples.h"
#include "renderer/views.h"

namespace tidemark::renderer {

// What is the same for all rays of a picture. The camera is orthographic: all rays have one direction.
struct PieceScene {
  struct Factor {
    TransferFactor::Kind kind = TransferFactor::Kind::everything;
    float start = 0.0F;
    float end = 1.0F;
  };
  struct Primitive {
    Factor value, gradient, phi;
    float opacity = 0.0F;  // of a mm
    glm::vec3 colour{0.0F};
  };

  const SourceSamples* source = nullptr;
  std::array<Primitive, TransferFunction::kMostPrimitives> primitives;
  int count = 0;
  bool fast_gradient = false;  // lights by differences within a voxel
  // Rays are more than a voxel apart: what one has read does not lie in caches for the next.
  bool rays_are_sparse = false;
  Region region = Region::everywhere;
  glm::vec3 tint{0.0F};  // of the inside in Region::tinted

  glm::vec3 direction{0.0F};        // of rays, in voxels; length 1
  float mm = 1.0F;                  // a unit along a ray
  glm::vec3 inverse_spacing{1.0F};  // 1 / mm
  glm::vec3 light{0.0F};  // unit vectors in mm along the voxel axes: to the light, and half-way to the viewer
  glm::vec3 half_way{0.0F};
  float ambient = 0.0F, diffuse = 0.0F, specular = 0.0F, shininess = 1.0F;
  // The cosine of the angle between the half-way direction and the slope below which nothing is specular.
  float least_mirrored = 0.0F;
};

// Neighbouring pieces of a ray. Some of them are gaps, in which nothing shows.
struct Pieces {
  static constexpr int kMost = 16;

  glm::vec3 start{0.0F};  // of the ray, voxel coordinates
  int count = 0;
  std::array<float, kMost> from;     // where each of them begins, but of a gap: where it ends
  std::array<float, kMost> to;       // where it ends
  std::array<float, kMost + 1> phi;  // where the first one begins, and where each of them ends
  float shows_from = 0.0F;           // the source shows between these places alone
  float shows_to = 0.0F;

  // The source where the pieces before these ended, and the integrals of the primitives' factors of it. The
  // first pieces of a ray begin with a gap, which sets both.
  float value = 0.0F;
  using Integrals = std::array<float, TransferFunction::kMostPrimitives>;
  Integrals integrals{};

  [[nodiscard]] bool ends_with_gap() const {
    const auto last = static_cast<std::size_t>(count) - 1;
    return count > 0 && from[last] == to[last];
  }
};

// Adds the pieces front to back to `result` (premultiplied), until it is opaque. `pieces` then has none, and
// goes on behind them.
using ShadePieces = void (*)(const PieceScene& scene, Pieces& pieces, glm::vec4& result);
// For the widest instruction set of this processor.
ShadePieces shade_pieces();

inline constexpr float kLeastOpacity = 1e-6F;  // of a piece
inline constexpr float kOpaque = 0.99F;        // a ray ends there

}  // namespace tidemark::renderer
