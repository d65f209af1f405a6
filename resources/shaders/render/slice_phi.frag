// phi and d phi / d voxel, from differences over a voxel to each side.

#include "solver/phi.glsl"
#include "render/slice_axes.glsl"

uniform int slice;

flat in ivec3 first_voxel;
flat in ivec3 origin[7];
out vec4 phi_and_rise;

float fetch(ivec3 page, ivec3 local) {
  return texelFetch(phi_pages, page + texel_in_page(local), 0).r;
}

// Half the difference of the neighbours along an axis, whose unit vector is `unit`. Beyond the volume phi goes on as it is
// on its last voxel.
float slope(ivec3 local, ivec3 unit, int at, int last, int in_page, int shape, ivec3 before, ivec3 behind) {
  bool leaves_low = in_page == 0;
  bool leaves_high = in_page == shape - 1;
  ivec3 low = at == 0 ? local : leaves_low ? local + (shape - 1) * unit : local - unit;
  ivec3 high = at == last ? local : leaves_high ? local - (shape - 1) * unit : local + unit;
  return 0.5 * (fetch(leaves_high && at < last ? behind : origin[0], high) -
                fetch(leaves_low && at > 0 ? before : origin[0], low));
}

void main() {
  ivec3 voxel = ivec3(slice);
  voxel.ACROSS = ivec2(gl_FragCoord.xy);
  ivec3 local = voxel - first_voxel;
  ivec3 last = volume_size - 1;
  const ivec2 u = ivec2(1, 0);
  phi_and_rise = vec4(fetch(origin[0], local),
                      slope(local, u.xyy, voxel.x, last.x, local.x, PAGE_X, origin[1], origin[2]),
                      slope(local, u.yxy, voxel.y, last.y, local.y, PAGE_Y, origin[3], origin[4]),
                      slope(local, u.yyx, voxel.z, last.z, local.z, PAGE_Z, origin[5], origin[6]));
}
