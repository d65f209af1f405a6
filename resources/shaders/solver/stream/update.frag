#include "solver/stream/differences.glsl"

// Step C (paper section 4.3): the upwind update, into G's other texture.

uniform sampler2D upwind_buffer;
uniform sampler2D speed_buffer;

flat in ivec2 to_place;

layout(location = 0) out float phi_next;

void main() {
  ivec2 texel = ivec2(gl_FragCoord.xy) + to_place;
  vec4 upwind = texelFetch(upwind_buffer, texel, 0);
  vec4 terms = texelFetch(speed_buffer, texel, 0);
  phi_next = upwind_update(upwind.x, Speeds(terms.x, terms.y, terms.z), upwind.y, upwind.z);
}
