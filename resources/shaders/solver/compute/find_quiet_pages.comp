#include "solver/compute/page_memory.glsl"

// At the end of a window of steps, an invocation a page of the active list: has it moved, and is it quiet? A page is
// quiet when it and those around it have been still.

layout(local_size_x = 64) in;

uniform float quiet_change;
uniform bool skip_quiet_pages;
uniform uint samples;  // of motion in a window
uniform float window_time;
uniform int windows_to_rest;
uniform float rest_content;
uniform float least_near_voxels;

bool is_still(int page) {
  return page < kFirstPage || (page_state[page].flags & kAsleep) != 0u ||
         page_state[page].change <= quiet_change;
}

// As MotionWatch::add_page() (solver/convergence.h).
void watch(int page) {
  PageState state = page_state[page];
  if (state.samples < samples) return;
  float content = state.content / float(samples);
  int window = control.window;
  if (state.since < control.first_window) {
    page_state[page].anchor = content;
    page_state[page].since = window;
    page_state[page].moved = -1;
    return;
  }
  float change = abs(content - state.anchor);
  float voxels = max(float(state.near_voxels) / float(samples), least_near_voxels);
  float time = float(window - state.since) * window_time;
  atomicMax(control.speed_so_far, floatBitsToUint(change / (voxels * time)));
  if (change > rest_content) {
    page_state[page].anchor = content;
    page_state[page].since = window;
    page_state[page].moved = state.moved = window;
  }
  if (state.moved >= control.first_window && window - state.moved < windows_to_rest) {
    atomicAdd(control.moving_so_far, 1u);
  }
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
  watch(page);
  // A page that waits for a page must not sleep over it.
  if (!skip_quiet_pages || control.starved != 0u) return;
  for (int i = 0; i < pages_in_reach(); ++i) {
    ivec3 other = page_coordinates(number) + step_in_reach(i);
    if (contains_page(other) && !is_still(page_table[page_number(other)])) return;
  }
  atomicOr(page_state[page].flags, kFallsAsleep);
}
