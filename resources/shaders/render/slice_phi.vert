// A slice of phi from the packed pages (paper section 5): a quad for each page that the slice passes. A page lies in G
// slice by slice along z. Across z, the quad is one such slice; along it, the quad's rows are a row or a column of each of
// the page's slices, and it is one texel high where pages are one slice thick.

#include "solver/phi.glsl"
#include "render/slice_axes.glsl"

uniform isamplerBuffer shown_pages;  // virtual pages, layer by layer
uniform int first_shown;             // of this slice's layer

flat out ivec3 first_voxel;          // of the page
// Where the page and its neighbours lie in G: itself, then before and behind it along x, y and z.
flat out ivec3 origin[7];

// Beyond the volume there is nothing to fetch, so any page will do.
ivec3 origin_of(ivec3 page) {
  return page_origin(physical_page(clamp(page, ivec3(0), page_grid - 1)));
}

void main() {
  int index = gl_VertexID / 6;
  int vertex = gl_VertexID - 6 * index;
  ivec2 corner = ivec2(vertex == 1 || vertex == 2 || vertex == 4, vertex == 2 || vertex == 4 || vertex == 5);
  ivec3 page = page_coordinates(texelFetch(shown_pages, first_shown + index).r);
  first_voxel = page * kPageShape;
  const ivec2 u = ivec2(1, 0);
  origin = ivec3[](origin_of(page), origin_of(page - u.xyy), origin_of(page + u.xyy), origin_of(page - u.yxy),
                   origin_of(page + u.yxy), origin_of(page - u.yyx), origin_of(page + u.yyx));
  vec2 at = vec2(min(first_voxel.ACROSS + corner * kPageShape.ACROSS, volume_size.ACROSS));
  gl_Position = vec4(2.0 * at / vec2(volume_size.ACROSS) - 1.0, 0.0, 1.0);
}
