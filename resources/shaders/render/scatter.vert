// Changed pages on their way to physical memory G: a quad for each, where its tile lies.

#include "solver/paging.glsl"

uniform isamplerBuffer addresses;  // the physical page of each
uniform vec2 texture_size;         // texels of G

flat out int first;         // of the page's values
flat out ivec2 tile_origin;

void main() {
  int index = gl_VertexID / 6;
  int vertex = gl_VertexID - 6 * index;
  ivec2 corner = ivec2(vertex == 1 || vertex == 2 || vertex == 4, vertex == 2 || vertex == 4 || vertex == 5);
  tile_origin = page_origin(texelFetch(addresses, index).r);
  first = index * kTile.x * kTile.y;
  gl_Position = vec4(2.0 * vec2(tile_origin + corner * kTile) / texture_size - 1.0, 0.0, 1.0);
}
