#include "solver/compute/page_memory.glsl"
#include "solver/speed/update.glsl"
#include "solver/source.glsl"

// One step of phi in the active pages, a work group each; an invocation computes a column of voxels along z. Each
// page's code says afterwards what it needs. With MEASURE_ONLY nothing is computed but the code of phi as it is.
//
// SHARED_APRON: the page and the voxels around it are brought to shared memory first (a GPU's way). Otherwise each
// invocation keeps three slices of its column in registers, which suits a processor that plays the GPU.

layout(local_size_x = PAGE_X, local_size_y = PAGE_Y) in;

uniform sampler2D phi_now;
layout(binding = 0, r32f) uniform restrict image2D phi_next;  // holds phi of one step earlier

uniform bool measure_motion;
uniform float near;  // |phi| of a voxel beside the surface is at most this
uniform int face_layers;

shared int neighbours[27];
shared uint group_code;
shared uint group_largest_change;
shared uint group_squared_change;  // in units of 2^-24
shared uint group_near_voxels;

// Of the page.
ivec3 first_voxel;
ivec3 lowest;   // the least and the greatest local coordinate with a voxel of its own, -1..PAGE
ivec3 highest;

void find_neighbours(int page) {
  ivec3 coordinates = page_coordinates(inverse_table[page]);
  first_voxel = coordinates * kPageShape;
  lowest = -ivec3(greaterThan(first_voxel, ivec3(0)));
  highest = min(kPageShape, volume_size - 1 - first_voxel);
  for (int i = int(gl_LocalInvocationIndex); i < 27; i += PAGE_X * PAGE_Y) {
    ivec3 other = coordinates + neighbour_step(i);
    neighbours[i] = contains_page(other) ? page_table[page_number(other)] : page;
  }
}

// Which page along an axis a local coordinate is in: -1, 0 or 1.
ivec3 page_step(ivec3 local) {
  return ivec3(greaterThanEqual(local, kPageShape)) - ivec3(lessThan(local, ivec3(0)));
}

// phi at a local coordinate in -1..PAGE; clamped at the volume's border.
ivec2 texel_at(ivec3 local) {
  ivec3 voxel = clamp(local, lowest, highest);
  ivec3 step = page_step(voxel);
  int page = neighbours[13 + step.x + 3 * step.y + 9 * step.z];
  return page_origin(page) + texel_in_page(voxel - step * kPageShape);
}

// The 3 x 3 values around a column in a slice: [0] x - 1, y - 1; [4] the column itself; [8] x + 1, y + 1.
#ifdef SHARED_APRON
const ivec3 kApron = kPageShape + 2;
shared float apron[kApron.x * kApron.y * kApron.z];

void gather_apron() {
  for (int i = int(gl_LocalInvocationIndex); i < kApron.x * kApron.y * kApron.z; i += PAGE_X * PAGE_Y) {
    ivec3 local = ivec3(i % kApron.x, i / kApron.x % kApron.y, i / (kApron.x * kApron.y)) - 1;
    apron[i] = texelFetch(phi_now, texel_at(local), 0).r;
  }
}
void load_slice(int z, out float slice[9]) {
  ivec2 local = ivec2(gl_LocalInvocationID.xy);
  int first = local.x + kApron.x * (local.y + kApron.y * (z + 1));
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 3; ++x) slice[3 * y + x] = apron[first + x + kApron.x * y];
  }
}
#else
ivec2 columns[9];  // the texel of each column's first slice in the page that is being walked

void find_columns(int page_along_z) {
  for (int i = 0; i < 9; ++i) {
    ivec3 local = clamp(ivec3(gl_LocalInvocationID.xy + uvec2(i % 3, i / 3), 0) - ivec3(1, 1, 0), lowest, highest);
    ivec3 step = page_step(local);
    columns[i] = page_origin(neighbours[13 + step.x + 3 * step.y + 9 * page_along_z]) + local.xy -
                 step.xy * kPageShape.xy;
  }
}
void load_slice(int z, out float slice[9]) {
  int inside = clamp(z, lowest.z, highest.z);
  int page_along_z = inside < 0 ? -1 : inside >= PAGE_Z ? 1 : 0;
  // At the volume's end the last slice is read again, and the columns stay.
  if (z == -1 || z == 0 || z == PAGE_Z) find_columns(page_along_z);
  ivec2 shift = texel_in_page(ivec3(0, 0, inside - page_along_z * PAGE_Z));
  for (int i = 0; i < 9; ++i) slice[i] = texelFetch(phi_now, columns[i] + shift, 0).r;
}
#endif

Stencil stencil_of(float below[9], float here[9], float above[9]) {
  return Stencil(here[4], here[3], here[5], here[1], here[7], below[4], above[4],  //
                 here[0], here[6], here[2], here[8],                              //
                 below[3], above[3], below[5], above[5],                          //
                 below[1], above[1], below[7], above[7]);
}

// What a voxel adds to the page's code.
uint code_of(float phi, ivec3 local) {
  bool not_inside = phi != band;
  bool not_outside = phi != -band;
  ivec3 last = min(kPageShape, volume_size - first_voxel) - 1;
  uint faces = uint(local.x < face_layers) | uint(local.x > last.x - face_layers) << 1 |
               uint(local.y < face_layers) << 2 | uint(local.y > last.y - face_layers) << 3 |
               uint(local.z < face_layers) << 4 | uint(local.z > last.z - face_layers) << 5;
  return (not_inside ? faces | kNotInside : 0u) | (not_outside ? faces << 6 | kNotOutside : 0u);
}

void main() {
  bool stopped = control.starved != 0u || (control.converged != 0u && control.stop_at_convergence != 0u);
  if (work_group() == 0u && gl_LocalInvocationIndex == 0u) {
    control.step_ran = stopped ? 0u : 1u;
    control.free_tail_ready = control.free_tail;
  }
  if (stopped) return;
  if (work_group() >= control.active_count) return;
  int page = active_list[work_group()];
  if (inverse_table[page] < 0) return;

  find_neighbours(page);
  if (gl_LocalInvocationIndex == 0u) {
    group_code = 0u;
    group_largest_change = 0u;
    group_squared_change = 0u;
    group_near_voxels = 0u;
  }
  barrier();
#if defined(SHARED_APRON) && !defined(MEASURE_ONLY)
  gather_apron();
  barrier();
#endif

  ivec2 column = ivec2(gl_LocalInvocationID.xy);
  ivec2 origin = page_origin(page);
  bool in_volume = all(lessThanEqual(column, highest.xy));
  uint code = 0u;
  if (in_volume) {
    float largest_change = 0.0;
    float squared_change = 0.0;
    uint near_voxels = 0u;
#ifndef MEASURE_ONLY
    float below[9], here[9], above[9];
    load_slice(-1, below);
    load_slice(0, here);
#endif
    for (int z = 0; z < PAGE_Z; ++z) {
      if (z > highest.z) break;
      ivec3 local = ivec3(column, z);
      ivec2 texel = origin + texel_in_page(local);
#ifdef MEASURE_ONLY
      float phi = texelFetch(phi_now, texel, 0).r;
#else
      load_slice(z + 1, above);
      float phi = updated_phi(differences(stencil_of(below, here, above)), source_at(first_voxel + local));
      if (measure_motion && abs(phi) <= near) {
        float change = abs(phi - imageLoad(phi_next, texel).r);
        largest_change = max(largest_change, change);
        squared_change += change * change;
        ++near_voxels;
      }
      imageStore(phi_next, texel, vec4(phi));
      below = here;
      here = above;
#endif
      code |= code_of(phi, local);
    }
    atomicOr(group_code, code);
    if (measure_motion && near_voxels > 0u) {
      atomicMax(group_largest_change, floatBitsToUint(largest_change));
      atomicAdd(group_squared_change, uint(squared_change * 16777216.0));
      atomicAdd(group_near_voxels, near_voxels);
    }
  }
  barrier();
  if (gl_LocalInvocationIndex != 0u) return;
  page_state[page].code = group_code;
#ifndef MEASURE_ONLY
  if (measure_motion) {
    page_state[page].change += uintBitsToFloat(group_largest_change);
    page_state[page].squared_change += float(group_squared_change) / 16777216.0;
    page_state[page].near_voxels += group_near_voxels;
  }
  ivec3 valid = min(kPageShape, highest + 1);
  uint voxels = uint(valid.x * valid.y * valid.z);
  uint old = atomicAdd(control.voxel_updates.x, voxels);
  if (old + voxels < old) atomicAdd(control.voxel_updates.y, 1u);
#endif
}
