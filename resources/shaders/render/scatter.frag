#include "solver/paging.glsl"

uniform samplerBuffer staged;  // the changed pages' tiles, one after the other

flat in int first;
flat in ivec2 tile_origin;
out float phi;

void main() {
  ivec2 texel = ivec2(gl_FragCoord.xy) - tile_origin;
  phi = texelFetch(staged, first + number_in_tile(texel)).r;
}
