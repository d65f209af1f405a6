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

void add_64(uint value) {
  uint old = atomicAdd(control.squared_change.x, value);
  if (old + value < old) atomicAdd(control.squared_change.y, 1u);
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
  atomicAdd(control.near_voxels, page_state[page].near_voxels);
  // Eight samples of changes below 1 in a page's voxels: 64 bits hold any sum.
  float squared = page_state[page].squared_change;
  add_64(uint(min(fract(squared) * 16777216.0, 16777215.0)));
  uint whole = uint(squared);
  atomicAdd(control.squared_change.y, whole >> 8);
  add_64((whole & 255u) << 24);
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
