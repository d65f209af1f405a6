#include "solver/compute/page_memory.glsl"

// Makes the active list anew, a work group a physical page: pages that were judged quiet go to sleep (both buffers
// become equal), the others are listed. With wake_all every page is listed.

layout(local_size_x = 64) in;

layout(binding = 0, r32f) uniform restrict image2DArray phi_now;
layout(binding = 1, r32f) uniform restrict image2DArray phi_other;
uniform bool wake_all;

shared bool falls_asleep;

void main() {
  int page = int(work_group()) + kFirstPage;
  int index = int(gl_LocalInvocationIndex);
  if (page >= inverse_table.length()) return;
  if (control.list_is_rebuilt == 0u) return;
  if (inverse_table[page] < 0) {
    if (index == 0) page_state[page].flags = 0u;
    return;
  }
  if (index == 0) {
    uint flags = page_state[page].flags;
    bool asleep = (flags & kAsleep) != 0u && !wake_all;
    falls_asleep = (flags & kFallsAsleep) != 0u && !wake_all;
    begin_samples(page);
    if (asleep || falls_asleep) {
      page_state[page].flags = kAsleep;
      atomicAdd(control.quiet_pages, 1u);
    } else {
      page_state[page].flags = 0u;
      add_to_active_list(page);
    }
  }
  barrier();
  if (!falls_asleep) return;
  ivec3 origin = page_origin(page);
  for (int i = index; i < kTile.x * kTile.y; i += 64) {
    ivec3 texel = origin + texel_of_tile(i);
    imageStore(phi_other, texel, imageLoad(phi_now, texel));
  }
}
