// Values from a buffer of pages for both textures of G, where they are combined by blending: the larger or the smaller.

uniform sampler2D values;

flat in ivec2 to_place;

layout(location = 0) out float phi_0;
layout(location = 1) out float phi_1;

void main() { phi_0 = phi_1 = texelFetch(values, ivec2(gl_FragCoord.xy) + to_place, 0).r; }
