// Walls and anchors over a slice, in the desktop's own colours and patterns: walls red and cross-hatched, anchors green
// and dotted, so that they are told apart without colours, too. Needs solver/volume_blocks.glsl.

uniform usampler2DArray constraint_blocks;  // as enum class Constraint
uniform isampler3D constraint_table;

const vec3 kWallColour = vec3(1.0, 0.35, 0.35);
const vec3 kAnchorColour = vec3(0.47, 0.90, 0.51);

vec3 with_constraint(vec3 colour, ivec3 voxel) {
  uint constraint = texelFetch(constraint_blocks, texel_in_blocks(constraint_table, voxel), 0).r;
  if (constraint == 0u || constraint > 2u) return colour;
  bool wall = constraint == 1u;
  vec2 pixel = gl_FragCoord.xy;
  vec2 diagonal = mod(vec2(pixel.x - pixel.y, pixel.x + pixel.y), 6.0);
  vec2 dot_at = mod(pixel, 4.0);
  bool strong = wall ? min(diagonal.x, diagonal.y) < 2.0 : max(dot_at.x, dot_at.y) < 2.0;
  return mix(colour, wall ? kWallColour : kAnchorColour, strong ? 0.85 : 0.3);
}
