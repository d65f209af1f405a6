// Step A of the message (paper section 4.4, figure 8): the two neighbour-information buffers. A texel says with 1 what
// its voxel gives notice of; the mean over the page says whether any voxel does.

#include "solver/stream/coordinates.glsl"

uniform sampler2D phi_now;
uniform float band;

flat in vec2 to_phi;

layout(location = 0) out vec4 across_in_slice;  // differs from its neighbour in the page at -x, +x, -y, +y
layout(location = 1) out vec4 across_slices;    // ... at -z, +z; is not inside; is not outside

float phi_at(vec2 position) { return textureLod(phi_now, position, 0.0).r; }

#if defined(INTERIOR)
flat in vec4 slice_shifts;
#else
flat in vec4 shifts[3];
#endif

void main() {
  vec2 here = gl_FragCoord.xy * phi_texel + to_phi;
  float phi = phi_at(here);
#if defined(INTERIOR)
  across_in_slice = vec4(0.0);
  vec4 slices = slice_shifts;
#else
  across_in_slice = vec4(notEqual(vec4(phi_at(here + shifts[0].xy), phi_at(here + shifts[0].zw),
                                       phi_at(here + shifts[1].xy), phi_at(here + shifts[1].zw)), vec4(phi)));
  vec4 slices = shifts[2];
#endif
  across_slices = vec4(notEqual(vec4(phi_at(here + slices.xy), phi_at(here + slices.zw), band, -band), vec4(phi)));
}
