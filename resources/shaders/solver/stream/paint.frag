// Values from a buffer of pages for both textures of G, where they are combined by blending: the larger or the smaller.

#include "solver/stream/coordinates.glsl"

uniform sampler2D values;

flat in vec2 to_place;

layout(location = 0) out float phi_0;
layout(location = 1) out float phi_1;

void main() { phi_0 = phi_1 = textureLod(values, gl_FragCoord.xy * place_texel + to_place, 0.0).r; }
