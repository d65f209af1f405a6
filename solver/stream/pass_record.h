// The record of a page's step: all that the passes of the stream executor make of it, from phi to its message
// (paper sections 3.3, 4.3 and 4.4, figures 5 to 8).
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <vector>

#include "solver/paging/paged_memory.h"
#include "solver/stream/page_message.h"

namespace tidemark::solver {

// What the processor does upon a page's message.
struct PageDecision {
  std::uint8_t allocates = 0;       // a bit a face: the page across it is made resident
  bool wakes_around = false;        // the quiet pages as far as the band reaches
  std::uint8_t constant_steps = 0;  // in a row, this one included
  bool frees = false;

  [[nodiscard]] bool allocates_across(int face) const { return (allocates >> face & 1U) != 0; }
};

// Lengths are in smallest spacings. Texels are those of a page, x fastest, 16 a row; beyond `valid` they are
// padding.
struct PassRecord {
  static constexpr int kSide = 16;
  static constexpr int kBordered = kSide + 2;
  static constexpr int kBlocks = kSide / 4;  // of the message's buffers, along a side

  // Address translation. A page that is not resident is one of the static pages, and has no passes.
  PageLayout layout;
  std::int64_t page = 0;  // VPN
  PhysicalPage physical = kOutsidePage;
  glm::i64vec2 address{0};      // PPA: the page's first texel in G, its layers one after the other along y
  glm::i64vec2 memory_size{0};  // of G, texels
  std::vector<PhysicalPage> slice;    // the page table's entries of the page's slice of V_P
  std::vector<std::int64_t> inverse;  // the inverse page table: the virtual pages of G_P; -1: free or static
  double band = 0.0;
  double time_step = 0.0;
  bool one_gradient = false;  // the paper's scheme: data and curvature share the upwind gradient of their sum
  bool quiet = false;         // it rests: the step leaves it out, and phi stays

  [[nodiscard]] bool is_resident() const { return !is_static_page(physical); }
  [[nodiscard]] Index3 valid() const { return layout.valid_shape(page); }

  // phi with the neighbours' borders: 18 x 18 values in each of three slices, the one below first. Beyond the
  // volume's border the nearest voxel counts.
  std::vector<float> phi;
  [[nodiscard]] float phi_at(int x, int y, int z = 0) const {
    const int at = (x + 1) + kBordered * ((y + 1) + kBordered * (z + 1));
    return phi[static_cast<std::size_t>(at)];
  }

  // Step A: the four buffers of derivatives (resources/shaders/solver/stream/differences.glsl).
  enum Buffer { upwind, central, second, mixed };
  std::array<std::vector<glm::vec4>, 4> differences;
  // Step B: data, curvature, rescaling, advection, each with its weight. Data, and with the paper's scheme
  // curvature, are speeds; the others have the gradient in them.
  std::vector<glm::vec4> speeds;
  // Step C.
  std::vector<float> next;

  // The message: its two buffers, whose texels are blocks of 4 x 4 voxels (neighbours.frag), and its byte.
  std::vector<glm::vec4> across_in_slice;  // -x, +x, -y, +y
  std::vector<glm::vec4> across_slices;    // -z, +z, is not inside, is not outside
  float window_change = 0.0F;  // the sum of the largest changes beside the surface since the window began
  PageMessage message;
  PageDecision decision;
};

}  // namespace tidemark::solver
