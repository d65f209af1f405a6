#include "solver/speed/update.glsl"
#include "solver/speed/data.glsl"

// The same equation for every voxel of a volume that lies in a buffer, voxel after voxel: what a program without pages
// computes. An invocation a voxel.

layout(local_size_x = 64, local_size_y = 4) in;

layout(std430, binding = 0) readonly buffer PhiNow { float phi_now[]; };
layout(std430, binding = 1) writeonly buffer PhiNext { float phi_next[]; };
layout(std430, binding = 2) readonly buffer Source { float source_values[]; };
uniform ivec3 volume_size;

float phi_at(ivec3 voxel) {
  ivec3 v = clamp(voxel, ivec3(0), volume_size - 1);
  return phi_now[v.x + volume_size.x * (v.y + volume_size.y * v.z)];
}

void main() {
  ivec3 v = ivec3(gl_GlobalInvocationID);
  if (any(greaterThanEqual(v, volume_size))) return;
  const ivec3 x = ivec3(1, 0, 0), y = ivec3(0, 1, 0), z = ivec3(0, 0, 1);
  Stencil s = Stencil(phi_at(v), phi_at(v - x), phi_at(v + x), phi_at(v - y), phi_at(v + y), phi_at(v - z), phi_at(v + z),
                      phi_at(v - x - y), phi_at(v - x + y), phi_at(v + x - y), phi_at(v + x + y),
                      phi_at(v - x - z), phi_at(v - x + z), phi_at(v + x - z), phi_at(v + x + z),
                      phi_at(v - y - z), phi_at(v - y + z), phi_at(v + y - z), phi_at(v + y + z));
  int at = v.x + volume_size.x * (v.y + volume_size.y * v.z);
  Differences d = differences(s);
  phi_next[at] = updated_phi(d, speeds(d, data_speed(source_values[at])));
}
