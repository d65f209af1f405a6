#include "solver/stream/coordinates.glsl"
#include "solver/stream/differences.glsl"
#include "solver/speed/constraints.glsl"

// Step C (paper section 4.3): the upwind update, into G's other texture.

uniform sampler2D upwind_buffer;
uniform sampler2D speed_buffer;

flat in vec2 to_place;
flat in ivec3 to_voxel;

layout(location = 0) out float phi_next;

void main() {
  vec2 here = gl_FragCoord.xy * place_texel + to_place;
  vec4 upwind = textureLod(upwind_buffer, here, 0.0);
  vec4 terms = textureLod(speed_buffer, here, 0.0);
  float phi = upwind_update(upwind.x, Speeds(terms.x, terms.y, terms.z, terms.w), upwind.y, upwind.z);
  phi_next = constrained(phi, ivec3(ivec2(gl_FragCoord.xy) + to_voxel.xy, to_voxel.z));
}
