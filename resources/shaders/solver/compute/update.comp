#include "solver/compute/neighbourhood.glsl"
#include "solver/speed/voxel_speeds.glsl"
#include "solver/speed/constraints.glsl"

// One step of phi in the active pages, a work group each. Each page's code says afterwards what it needs. With
// MEASURE_ONLY nothing is computed but the code of phi as it is.
// An invocation computes DEPTH voxels of each column of a block (neighbourhood.glsl). FOR_BLOCK(F) is F(0) F(1) ... for
// these columns.
// Padding beyond the volume is computed along with the rest, but never counted.

layout(local_size_x = PAGE_X, local_size_y = PAGE_Y / BLOCK, local_size_z = PAGE_Z / DEPTH) in;

layout(binding = 0, r32f) uniform restrict image2DArray phi_next;  // holds phi of one step earlier

uniform bool measure_motion;
uniform float near;  // |phi| of a voxel beside the surface is at most this

shared uint group_code;
shared uint group_largest_change;
shared float contents[kInvocations];  // of each invocation
shared uint group_near_voxels;

// Of the invocation.
uint code = 0u;
float largest_change = 0.0;
float content = 0.0;
uint near_voxels = 0u;

// The stencil of column `i` of the block.
Stencil stencil_of(int i, float below[SLICE_VALUES], float here[SLICE_VALUES], float above[SLICE_VALUES]) {
  int c = 3 * (i + 1) + 1;
  return Stencil(here[c], here[c - 1], here[c + 1], here[c - 3], here[c + 3], below[c], above[c],  //
                 here[c - 4], here[c + 2], here[c - 2], here[c + 4],                               //
                 below[c - 1], above[c - 1], below[c + 1], above[c + 1],                           //
                 below[c - 3], above[c - 3], below[c + 3], above[c + 3]);
}

// What a voxel adds to the page's code.
uint code_of(float phi, ivec3 local) {
  uint faces = uint(local.x == 0) | uint(local.x == last.x) << 1 | uint(local.y == 0) << 2 |
               uint(local.y == last.y) << 3 | uint(local.z == 0) << 4 | uint(local.z == last.z) << 5;
  return (phi != band ? faces | kNotInside : 0u) | (phi != -band ? faces << 6 | kNotOutside : 0u);
}

void note(float phi, float phi_before, ivec3 local) {
  bool in_volume = all(lessThanEqual(local, last));
  code |= in_volume ? code_of(phi, local) : 0u;
  bool counts = in_volume && abs(phi) <= near;
  float change = counts ? abs(phi - phi_before) : 0.0;
  largest_change = max(largest_change, change);
  content += in_volume ? clamp(phi, -near, near) + near : 0.0;
  near_voxels += uint(counts);
}

void compute_voxel(int i, int z, float below[SLICE_VALUES], float here[SLICE_VALUES], float above[SLICE_VALUES]) {
  ivec3 local = ivec3(block_start + ivec2(0, i), z);
  ivec3 texel = origin + texel_in_page(local);
  ivec3 voxel = first_voxel + min(local, last);
  Differences d = differences(stencil_of(i, below, here, above));
  float phi = constrained(updated_phi(d, speeds_at(voxel, d)), voxel);
  note(phi, measure_motion ? imageLoad(phi_next, texel).r : phi, local);
  imageStore(phi_next, texel, vec4(phi));
}

void compute_block() {
  float below[SLICE_VALUES], here[SLICE_VALUES], above[SLICE_VALUES];
  load_slice(first_slice - 1, below);
  load_slice(first_slice, here);
  for (int z = first_slice; z < first_slice + DEPTH; ++z) {
    load_slice(z + 1, above);
#define COMPUTE_VOXEL(i) compute_voxel(i, z, below, here, above);
    FOR_BLOCK(COMPUTE_VOXEL)
    below = here;
    here = above;
  }
}

// Adds all contents up in the first, in the same order every time.
void sum_contents() {
  int index = int(gl_LocalInvocationIndex);
  for (int count = kInvocations; count > 1; count = (count + 1) / 2) {
    barrier();
    int upper = index + (count + 1) / 2;
    if (upper < count) contents[index] += contents[upper];
  }
}

void measure_block() {
  for (int z = first_slice; z < first_slice + DEPTH; ++z) {
    for (int i = 0; i < BLOCK; ++i) {
      ivec3 local = ivec3(block_start + ivec2(0, i), z);
      float phi = texelFetch(phi_now, origin + texel_in_page(local), 0).r;
      note(phi, phi, local);
    }
  }
}

void main() {
  bool stopped = control.starved != 0u || (control.converged != 0u && control.stop_at_convergence != 0u);
  if (work_group() == 0u && gl_LocalInvocationIndex == 0u) {
    control.step_ran = stopped ? 0u : 1u;
    control.free_tail_ready = control.free_tail;
    control.active_ready = control.active_count;
  }
  if (stopped || work_group() >= control.active_count) return;
  int page = active_list[work_group()];
  if (inverse_table[page] < 0) return;

  block_start = ivec2(gl_LocalInvocationID.xy) * ivec2(1, BLOCK);
  first_slice = int(gl_LocalInvocationID.z) * DEPTH;
  find_neighbours(page);
  if (gl_LocalInvocationIndex == 0u) {
    group_code = 0u;
    group_largest_change = 0u;
    group_near_voxels = 0u;
  }
  barrier();
#ifdef MEASURE_ONLY
  measure_block();
#else
#ifdef SHARED_APRON
  gather_apron();
  barrier();
#endif
  compute_block();
#endif
  // Atomic operations on one word follow each other: those that change nothing are left out.
  if ((code & ~group_code) != 0u) atomicOr(group_code, code);
  if (measure_motion) {
    if (floatBitsToUint(largest_change) > group_largest_change) {
      atomicMax(group_largest_change, floatBitsToUint(largest_change));
    }
    if (near_voxels != 0u) atomicAdd(group_near_voxels, near_voxels);
    contents[gl_LocalInvocationIndex] = content;
    sum_contents();
  }
  barrier();
  if (gl_LocalInvocationIndex != 0u) return;
  uint asked = 0u;
  for (int face = 0; face < 6; ++face) {
    ivec3 step = kFaceSteps[face];
    int across = neighbours[13 + step.x + 3 * step.y + 9 * step.z];
    uint differs = across == kInsidePage ? kFaceNotInside : across == kOutsidePage ? kFaceNotOutside : 0u;
    if ((group_code & differs << face) != 0u) asked |= kAsks << face;
  }
  page_state[page].code = group_code | asked;
#ifndef MEASURE_ONLY
  if (measure_motion) {
    page_state[page].change += uintBitsToFloat(group_largest_change);
    page_state[page].content += contents[0];
    page_state[page].near_voxels += group_near_voxels;
    ++page_state[page].samples;
  }
  uint voxels = uint((last.x + 1) * (last.y + 1) * (last.z + 1));
  uint old = atomicAdd(control.voxel_updates.x, voxels);
  if (old + voxels < old) atomicAdd(control.voxel_updates.y, 1u);
#endif
}
