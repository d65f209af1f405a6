#include "solver/compute/page_memory.glsl"

// At the end of a window of steps, an invocation a page of the active list: is it quiet? A page is when it and
// those around it have been still.

layout(local_size_x = 64) in;

uniform float quiet_change;
uniform bool skip_quiet_pages;

bool is_still(int page) {
  return page < kFirstPage || (page_state[page].flags & kAsleep) != 0u ||
         page_state[page].change <= quiet_change;
}

// Of a page, more than this counts as this: a voxel's mean change is then some 8192 smallest spacings, and the surface
// is as far from rest either way.
const float kMostSquaredChange = 274877906944.0;  // 2^38

// Of integers, the sum is the same in every order of the pages. 2^31 pages of 2^38 are below the 2^72 that it holds.
void add_squared_change(float squared) {
  float units = min(squared, kMostSquaredChange) * 16777216.0;
  uint high = uint(units / 4294967296.0);
  uint low = uint(units - float(high) * 4294967296.0);  // exact: `units` has 24 bits
  uint old = atomicAdd(control.squared_change[0], low);
  if (old + low < old) ++high;
  old = atomicAdd(control.squared_change[1], high);
  if (old + high < old) atomicAdd(control.squared_change[2], 1u);
}

void add_near_voxels(uint voxels) {
  uint old = atomicAdd(control.near_voxels[0], voxels);
  if (old + voxels < old) atomicAdd(control.near_voxels[1], 1u);
}

void main() {
  if (control.step_ran == 0u) return;
  uint rows = (control.active_count + 63u) / 64u;
  // The dispatch has a group for each page; only one in 64 has work.
  if (work_group() >= rows) return;
  uint index = work_group() * 64u + gl_LocalInvocationIndex;
  if (index >= control.active_count) return;
  int page = active_list[index];
  int number = inverse_table[page];
  if (number < 0) return;
  add_near_voxels(page_state[page].near_voxels);
  float squared = page_state[page].squared_change;
  add_squared_change(squared);
  uint voxels = page_state[page].near_voxels;
  if (voxels > 0u) atomicMax(control.fastest_page, floatBitsToUint(squared / float(voxels)));
  // A page that waits for a page must not sleep over it.
  if (!skip_quiet_pages || control.starved != 0u) return;
  for (int i = 0; i < pages_in_reach(); ++i) {
    ivec3 other = page_coordinates(number) + step_in_reach(i);
    if (contains_page(other) && !is_still(page_table[page_number(other)])) return;
  }
  atomicOr(page_state[page].flags, kFallsAsleep);
}
