// The byte that a page sends after a step, from which pages are allocated and freed (paper section 4.4,
// figure 8).
#pragma once

#include <cstdint>

namespace tidemark::solver {

struct PageMessage {
  std::uint8_t code = 0;

  // Some voxel on the face (0 to 5: -x, +x, -y, +y, -z, +z) differs from its neighbour across it.
  [[nodiscard]] bool differs_across(int face) const { return (code >> face & 1U) != 0; }
  [[nodiscard]] bool differs_across_any() const { return (code & 0x3fU) != 0; }
  // Not all voxels are the same one of W and -W.
  [[nodiscard]] bool is_mixed() const { return (code & 0x40U) != 0; }
  // Of a page that is mixed: it moved since the window began. A page that is not has no voxel beside the
  // surface.
  [[nodiscard]] bool moved() const { return is_mixed() && (code & 0x80U) != 0; }
  // Of a page that is not mixed: its voxels are W, not -W.
  [[nodiscard]] bool is_inside() const { return !is_mixed() && (code & 0x80U) != 0; }
};

}  // namespace tidemark::solver
