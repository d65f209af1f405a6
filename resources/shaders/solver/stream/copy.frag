// Brings texels from G's one texture to the other, for pages that fall asleep.

#include "solver/stream/coordinates.glsl"

uniform sampler2DArray phi_now;

flat in vec2 to_phi;

layout(location = 0) out float phi_other;

void main() { phi_other = texel_of(phi_now, gl_FragCoord.xy * phi_texel + to_phi); }
