// Walls and anchors: with CONSTRAINED, voxels that the surface may never enclose, those that it always encloses, and limits of
// phi as solver/speed/constraints.h has them.

#include "solver/volume_blocks.glsl"

#ifdef CONSTRAINED
uniform highp usampler2DArray constraint_blocks;
uniform highp isampler3D constraint_table;

const uint kWall = 1u;  // as enum class Constraint
const uint kAnchor = 2u;
const float kConstraintDepth = 0.5;
const uint kFirstAtMost = 3u;
const uint kFirstAtLeast = 100u;
const float kLimitSteps = 32.0;
const float kLimitReach = 1.5;

float constrained(float phi, ivec3 voxel) {
  uint constraint = texelFetch(constraint_blocks, texel_in_blocks(constraint_table, voxel), 0).r;
  if (constraint == 0u) return phi;
  bool upper = constraint == kWall || (constraint >= kFirstAtMost && constraint < kFirstAtLeast);
  float limit = float(constraint - (constraint < kFirstAtLeast ? kFirstAtMost : kFirstAtLeast)) / kLimitSteps - kLimitReach;
  if (constraint < kFirstAtMost) limit = constraint == kWall ? -kConstraintDepth : kConstraintDepth;
  return upper ? min(phi, limit) : max(phi, limit);
}
#else
float constrained(float phi, ivec3 voxel) { return phi; }
#endif
