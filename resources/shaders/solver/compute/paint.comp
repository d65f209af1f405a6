#include "solver/compute/page_memory.glsl"
#include "solver/speed/constraints.glsl"

// Adds or erases a sphere, a work group a page of V_P that it may touch: phi = max(phi, d) or min(phi, -d), d the signed
// distance to the sphere in units of the smallest spacing, but for walls and anchors. Pages are made where something is
// drawn.

layout(local_size_x = PAGE_X, local_size_y = PAGE_Y) in;

layout(binding = 0, r32f) uniform restrict image2DArray phi_now;
layout(binding = 1, r32f) uniform restrict writeonly image2DArray phi_other;
uniform ivec3 first_page;
uniform vec3 centre;          // voxels
uniform float radius;         // in units of the smallest spacing
uniform vec3 spacing;         // likewise
uniform float band;
uniform bool erase;
uniform bool only_count;  // the pages that must be made

shared uint group_code;
shared int page;
shared bool changed;

float painted(float phi, ivec3 voxel) {
  float d = clamp(radius - length((vec3(voxel) - centre) * spacing), -band, band);
  return constrained(erase ? min(phi, -d) : max(phi, d), voxel);
}

void main() {
  ivec3 coordinates = first_page + ivec3(gl_WorkGroupID);
  int number = page_number(coordinates);
  ivec3 first_voxel = coordinates * kPageShape;
  ivec3 valid = min(kPageShape, volume_size - first_voxel);
  ivec2 column = ivec2(gl_LocalInvocationID.xy);
  bool in_volume = all(lessThan(column, valid.xy));
  if (gl_LocalInvocationIndex == 0u) {
    page = page_table[number];
    group_code = 0u;
    changed = false;
  }
  barrier();
  int entry = page;
  bool resident = entry >= kFirstPage;
  float constant = entry == kInsidePage ? band : -band;
  ivec3 origin = resident ? page_origin(entry) : ivec3(0);
  uint code = 0u;
  bool different = false;
  if (in_volume) {
    for (int z = 0; z < valid.z; ++z) {
      ivec3 local = ivec3(column, z);
      float old = resident ? imageLoad(phi_now, origin + texel_in_page(local)).r : constant;
      float phi = painted(old, first_voxel + local);
      different = different || phi != old;
      code |= (phi != band ? kNotInside : 0u) | (phi != -band ? kNotOutside : 0u);
    }
  }
  if (different) changed = true;
  atomicOr(group_code, code);
  barrier();
  if (!changed) return;
  bool constant_after = (group_code & kNotInside) == 0u || (group_code & kNotOutside) == 0u;
  if (only_count) {
    if (gl_LocalInvocationIndex == 0u && !resident && !constant_after) atomicAdd(control.pages_wanted, 1u);
    return;
  }
  if (gl_LocalInvocationIndex == 0u) {
    // A page that is one constant throughout needs no memory.
    if (!resident && (group_code & kNotOutside) == 0u) {
      page_table[number] = kOutsidePage;
    } else if (!resident && (group_code & kNotInside) == 0u) {
      page_table[number] = kInsidePage;
    } else if (!resident) {
      page = make_resident(number, entry);
    }
  }
  barrier();
  if (page >= kFirstPage && in_volume) {
    ivec3 to = page_origin(page);
    for (int z = 0; z < valid.z; ++z) {
      ivec3 local = ivec3(column, z);
      float old = resident ? imageLoad(phi_now, to + texel_in_page(local)).r : constant;
      float phi = painted(old, first_voxel + local);
      imageStore(phi_now, to + texel_in_page(local), vec4(phi));
      imageStore(phi_other, to + texel_in_page(local), vec4(phi));
    }
  }
  // What touches the page is computed again.
  for (int i = int(gl_LocalInvocationIndex); i < pages_in_reach(); i += PAGE_X * PAGE_Y) {
    ivec3 other = coordinates + step_in_reach(i);
    if (!contains_page(other)) continue;
    int touched = page_table[page_number(other)];
    if (touched >= kFirstPage) wake(touched);
  }
}
