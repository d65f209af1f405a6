// phi at any voxel and between voxels, straight from the packed pages. SOFTWARE_RASTERISER: the driver computes both sides
// of every branch (a processor that plays the GPU).

#include "solver/paging.glsl"

uniform sampler2DArray phi_pages;      // physical memory G
uniform vec2 phi_texel;                // a texel of it in texture coordinates
uniform isamplerBuffer page_table;     // V_P -> G_P
uniform float band;

// The physical page of a page of V_P.
int physical_page(ivec3 page) {
  return texelFetch(page_table, page_number(page)).r;
}

// By coordinates, not by number: drivers on a processor work out a level for each texel that is fetched by number.
float phi_in(int physical, ivec3 local) {
  ivec3 texel = page_origin(physical) + texel_in_page(local);
  return textureLod(phi_pages, vec3((vec2(texel.xy) + 0.5) * phi_texel, texel.z), 0.0).r;
}

float phi_at(ivec3 voxel) {
  ivec3 v = clamp(voxel, ivec3(0), volume_size - 1);
  ivec3 page = v / kPageShape;
  return phi_in(physical_page(page), v - page * kPageShape);
}

// Trilinear; `position` in voxel coordinates, integers at voxel centres.
float phi_between(vec3 position) {
  vec3 p = clamp(position, vec3(0.0), vec3(volume_size - 1));
  ivec3 low = min(ivec3(p), max(volume_size - 2, ivec3(0)));
  vec3 f = p - vec3(low);
  const ivec2 u = ivec2(1, 0);
  vec4 below, above;  // the corners (0,0), (1,0), (0,1), (1,1) along x and y
#ifndef SOFTWARE_RASTERISER
  ivec3 page = low / kPageShape;
  ivec3 local = low - page * kPageShape;
  if (all(lessThan(local + 1, kPageShape))) {
    // All eight in one page, as most are.
    int physical = physical_page(page);
    if (physical < kFirstPage) return physical == kInsidePage ? band : -band;
    below = vec4(phi_in(physical, local), phi_in(physical, local + u.xyy), phi_in(physical, local + u.yxy),
                 phi_in(physical, local + u.xxy));
    above = vec4(phi_in(physical, local + u.yyx), phi_in(physical, local + u.xyx), phi_in(physical, local + u.yxx),
                 phi_in(physical, local + u.xxx));
  } else
#endif
  {
    below = vec4(phi_at(low), phi_at(low + u.xyy), phi_at(low + u.yxy), phi_at(low + u.xxy));
    above = vec4(phi_at(low + u.yyx), phi_at(low + u.xyx), phi_at(low + u.yxx), phi_at(low + u.xxx));
  }
  vec4 along_z = mix(below, above, f.z);
  vec2 along_y = mix(along_z.xy, along_z.zw, f.y);
  return mix(along_y.x, along_y.y, f.x);
}

// d phi / d voxel, from differences over a voxel to each side.
vec3 phi_slope(vec3 p) {
  const vec2 h = vec2(1.0, 0.0);
  return 0.5 * vec3(phi_between(p + h.xyy) - phi_between(p - h.xyy), phi_between(p + h.yxy) - phi_between(p - h.yxy),
                    phi_between(p + h.yyx) - phi_between(p - h.yyx));
}
