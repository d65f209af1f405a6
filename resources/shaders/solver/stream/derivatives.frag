#include "solver/stream/coordinates.glsl"
#include "solver/stream/differences.glsl"

// Step A of the level-set computation (paper section 4.3): the neighbourhood is gathered once, all differences follow.
// Where each neighbour lies is settled before a fragment is born.

uniform sampler2DArray phi_now;
uniform sampler2DArray phi_before;  // one step earlier
uniform bool measure_motion;

flat in vec2 to_phi;

layout(location = 0) out vec4 upwind;
layout(location = 1) out vec4 central;
layout(location = 2) out vec4 second;
layout(location = 3) out vec4 mixed;

float phi_at(vec2 position) { return texel_of(phi_now, position); }

#if defined(INTERIOR)
flat in vec4 slice_shifts;

Stencil gather(vec2 here) {
  vec2 x = vec2(phi_texel.x, 0.0);
  vec2 y = vec2(0.0, phi_texel.y);
  vec2 below = here + slice_shifts.xy;
  vec2 above = here + slice_shifts.zw;
  return Stencil(phi_at(here), phi_at(here - x), phi_at(here + x), phi_at(here - y), phi_at(here + y),
                 phi_at(below), phi_at(above),
                 phi_at(here - x - y), phi_at(here - x + y), phi_at(here + x - y), phi_at(here + x + y),
                 phi_at(below - x), phi_at(above - x), phi_at(below + x), phi_at(above + x),
                 phi_at(below - y), phi_at(above - y), phi_at(below + y), phi_at(above + y));
}
#else
flat in vec4 shifts[9];

Stencil gather(vec2 here) {
  return Stencil(phi_at(here), phi_at(here + shifts[0].xy), phi_at(here + shifts[0].zw),
                 phi_at(here + shifts[1].xy), phi_at(here + shifts[1].zw),
                 phi_at(here + shifts[2].xy), phi_at(here + shifts[2].zw),
                 phi_at(here + shifts[3].xy), phi_at(here + shifts[3].zw),
                 phi_at(here + shifts[4].xy), phi_at(here + shifts[4].zw),
                 phi_at(here + shifts[5].xy), phi_at(here + shifts[5].zw),
                 phi_at(here + shifts[6].xy), phi_at(here + shifts[6].zw),
                 phi_at(here + shifts[7].xy), phi_at(here + shifts[7].zw),
                 phi_at(here + shifts[8].xy), phi_at(here + shifts[8].zw));
}
#endif

void main() {
  vec2 here = gl_FragCoord.xy * phi_texel + to_phi;
  float earlier = measure_motion ? texel_of(phi_before, here) : 0.0;
  PackedDifferences d = pack(differences(gather(here)), earlier);
  upwind = d.upwind;
  central = d.central;
  second = d.second;
  mixed = d.mixed;
}
