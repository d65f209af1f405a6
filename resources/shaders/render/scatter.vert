// Changed pages on their way to a layer of physical memory G: a quad for each, where its tile lies.

#include "solver/paging.glsl"

uniform isamplerBuffer addresses;  // the physical page of each
uniform vec2 texture_size;         // texels of a layer of G
uniform int target_layer;

flat out int first;         // of the page's values
flat out ivec2 tile_origin;

void main() {
  int index = gl_VertexID / 6;
  int vertex = gl_VertexID - 6 * index;
  ivec2 corner = ivec2(vertex == 1 || vertex == 2 || vertex == 4, vertex == 2 || vertex == 4 || vertex == 5);
  ivec3 origin = page_origin(texelFetch(addresses, index).r);
  tile_origin = origin.xy;
  first = index * kTile.x * kTile.y;
  vec2 at = 2.0 * vec2(tile_origin + corner * kTile) / texture_size - 1.0;
  gl_Position = origin.z == target_layer ? vec4(at, 0.0, 1.0) : vec4(2.0, 2.0, 2.0, 1.0);  // else clipped
}
