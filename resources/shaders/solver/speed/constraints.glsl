// Walls and anchors: with CONSTRAINED, voxels that the surface may never enclose, and those that it always encloses.

#ifdef CONSTRAINED
uniform highp usampler3D constraint_volume;

const uint kWall = 1u;  // as enum class Constraint
const uint kAnchor = 2u;
const float kConstraintDepth = 0.5;

float constrained(float phi, ivec3 voxel) {
  uint constraint = texelFetch(constraint_volume, voxel, 0).r;
  return constraint == kWall ? min(phi, -kConstraintDepth) : constraint == kAnchor ? max(phi, kConstraintDepth) : phi;
}
#else
float constrained(float phi, ivec3 voxel) { return phi; }
#endif
