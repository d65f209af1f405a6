// The pages around a page: its six faces, and all 26 that touch it.
#pragma once

#include "core/geometry.h"

namespace tidemark::solver {

// -x, +x, -y, +y, -z, +z. Shaders have the same order (resources/shaders/solver/compute/page_memory.glsl).
inline constexpr int kFaces = 6;
inline constexpr Index3 kFaceSteps[kFaces] = {{-1, 0, 0}, {1, 0, 0},  {0, -1, 0},
                                              {0, 1, 0},  {0, 0, -1}, {0, 0, 1}};
constexpr int opposite_face(int face) {
  return face ^ 1;
}

// A page and those around it, numbered with x fastest; the page itself is in the middle.
inline constexpr int kNeighbours = 27;
inline constexpr int kItself = 13;
constexpr int neighbour_number(int dx, int dy, int dz) {
  return kItself + dx + 3 * dy + 9 * dz;
}
constexpr Index3 neighbour_step(int number) {
  return {number % 3 - 1, number / 3 % 3 - 1, number / 9 - 1};
}
// The number that the page itself has among the neighbours of its neighbour.
constexpr int opposite_neighbour(int number) {
  return kNeighbours - 1 - number;
}
constexpr int face_neighbour(int face) {
  constexpr int kSteps[] = {1, 3, 9};
  return kItself + (face % 2 == 0 ? -1 : 1) * kSteps[face / 2];
}

}  // namespace tidemark::solver
