// Walls and anchors over a slice: two colours, and lines that rise to the right in walls and level lines in anchors, so
// that they are told apart without colours, too.

uniform usampler3D constraint_volume;  // as enum class Constraint

const vec3 kWallColour = vec3(0.90, 0.20, 0.45);
const vec3 kAnchorColour = vec3(0.10, 0.75, 0.80);

vec3 with_constraint(vec3 colour, ivec3 voxel) {
  uint constraint = texelFetch(constraint_volume, voxel, 0).r;
  if (constraint == 0u) return colour;
  bool wall = constraint == 1u;
  float across = wall ? gl_FragCoord.x - gl_FragCoord.y : gl_FragCoord.y;
  float share = mod(across, 6.0) < 2.0 ? 0.85 : 0.3;
  return mix(colour, wall ? kWallColour : kAnchorColour, share);
}
