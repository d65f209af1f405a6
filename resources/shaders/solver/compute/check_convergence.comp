#include "solver/compute/page_memory.glsl"

// At the end of a window, one invocation: has the surface stopped? Then begins a new active list.

layout(local_size_x = 1) in;

uniform bool judge_motion;  // false when the list is only made anew
uniform bool restart;       // what moved so far no longer counts
uniform int windows_to_rest;

void main() {
  control.list_is_rebuilt = !judge_motion || control.step_ran != 0u ? 1u : 0u;
  if (control.list_is_rebuilt == 0u) return;
  if (judge_motion) {
    ++control.window;
    control.moving_pages = control.moving_so_far;
    control.surface_speed = uintBitsToFloat(control.speed_so_far);
    bool rests = control.moving_pages == 0u && control.window - control.first_window > windows_to_rest;
    control.converged = rests ? 1u : 0u;
  }
  if (restart) control.first_window = control.window;
  control.moving_so_far = 0u;
  control.speed_so_far = 0u;
  control.quiet_pages = 0u;
  control.active_count = 0u;
  control.active_groups = uvec3(1u);
}
