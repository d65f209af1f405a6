#include "solver/compute/page_memory.glsl"

// At the end of a window, one invocation: has the surface stopped? Then begins a new active list.

layout(local_size_x = 1) in;

uniform bool judge_motion;  // false when the list is only made anew
uniform uint samples;       // of motion in a window
uniform float time_step;
uniform float converged_speed;
uniform float fastest_page_weight;

void main() {
  control.list_is_rebuilt = !judge_motion || control.step_ran != 0u ? 1u : 0u;
  if (control.list_is_rebuilt == 0u) return;
  if (judge_motion) {
    float squared = float(control.squared_change[2]) * 1099511627776.0 +
                    float(control.squared_change[1]) * 256.0 + float(control.squared_change[0]) / 16777216.0;
    float voxels = float(control.near_voxels[1]) * 4294967296.0 + float(control.near_voxels[0]) +
                   float(control.quiet_near_voxels) * float(samples);
    float mean = voxels == 0.0 ? 0.0 : squared / voxels;
    float fastest = fastest_page_weight * fastest_page_weight * uintBitsToFloat(control.fastest_page);
    control.surface_speed = sqrt(max(mean, fastest)) / (2.0 * time_step);
    control.converged = control.surface_speed < converged_speed ? 1u : 0u;
  }
  for (int i = 0; i < 3; ++i) control.squared_change[i] = 0u;
  control.fastest_page = 0u;
  control.near_voxels[0] = control.near_voxels[1] = 0u;
  control.quiet_near_voxels = 0u;
  control.quiet_pages = 0u;
  control.active_count = 0u;
  control.active_groups = uvec4(1u, 1u, 1u, 0u);
}
