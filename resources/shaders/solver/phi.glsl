// phi at any voxel and between voxels, straight from the packed pages.

#include "solver/paging.glsl"

uniform sampler2D phi_pages;           // physical memory G
uniform isamplerBuffer page_table;     // V_P -> G_P
uniform float band;

// The physical page of a page of V_P.
int physical_page(ivec3 page) {
  return texelFetch(page_table, page_number(page)).r;
}

float phi_at(ivec3 voxel) {
  ivec3 v = clamp(voxel, ivec3(0), volume_size - 1);
  ivec3 page = v / kPageShape;
  return texelFetch(phi_pages, page_origin(physical_page(page)) + texel_in_page(v - page * kPageShape), 0).r;
}

// Trilinear; `position` in voxel coordinates, integers at voxel centres.
float phi_between(vec3 position) {
  vec3 p = clamp(position, vec3(0.0), vec3(volume_size - 1));
  ivec3 low = min(ivec3(p), max(volume_size - 2, ivec3(0)));
  vec3 f = p - vec3(low);
  ivec3 page = low / kPageShape;
  ivec3 local = low - page * kPageShape;
  float v[8];
  if (all(lessThan(local + 1, kPageShape))) {
    // All eight in one page, as most are.
    int physical = physical_page(page);
    if (physical < kFirstPage) return physical == kInsidePage ? band : -band;
    ivec2 origin = page_origin(physical);
    for (int i = 0; i < 8; ++i) {
      ivec3 corner = local + ivec3(i & 1, i >> 1 & 1, i >> 2);
      v[i] = texelFetch(phi_pages, origin + texel_in_page(corner), 0).r;
    }
  } else {
    for (int i = 0; i < 8; ++i) v[i] = phi_at(low + ivec3(i & 1, i >> 1 & 1, i >> 2));
  }
  vec4 along_x = mix(vec4(v[0], v[2], v[4], v[6]), vec4(v[1], v[3], v[5], v[7]), f.x);
  vec2 along_y = mix(along_x.xz, along_x.yw, f.y);
  return mix(along_y.x, along_y.y, f.z);
}

// d phi / d voxel, from differences over a voxel to each side.
vec3 phi_slope(vec3 p) {
  const vec2 h = vec2(1.0, 0.0);
  return 0.5 * vec3(phi_between(p + h.xyy) - phi_between(p - h.xyy), phi_between(p + h.yxy) - phi_between(p - h.yxy),
                    phi_between(p + h.yyx) - phi_between(p - h.yyx));
}
