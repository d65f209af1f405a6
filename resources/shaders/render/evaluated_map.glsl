// A map that the processor evaluated where the picture shows it (renderer/gl/speed_picture.h), between voxels: D, its doubt, or
// how far the surface has moved. Needs solver/phi.glsl.

#include "solver/speed/speed_volume.glsl"

// Trilinear.
float evaluated_between(vec3 position) {
  vec3 p = clamp(position, vec3(0.0), vec3(volume_size - 1));
  ivec3 low = min(ivec3(p), max(volume_size - 2, ivec3(0)));
  vec3 f = p - vec3(low);
  float sum = 0.0;
  for (int i = 0; i < 8; ++i) {
    ivec3 corner = ivec3(i & 1, i >> 1 & 1, i >> 2);
    vec3 share = mix(1.0 - f, f, vec3(corner));
    sum += share.x * share.y * share.z * speed_at(min(low + corner, volume_size - 1));
  }
  return sum;
}
