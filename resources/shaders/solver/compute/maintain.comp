#include "solver/compute/page_memory.glsl"

// Maintenance of the computational domain (paper section 4.4), a work group a page of the active list: grants what
// the page's code asks for, gives the page back when it has become constant, and wakes the pages around it when it
// moves.

layout(local_size_x = MAINTAINERS) in;
const int kInvocations = MAINTAINERS;  // 8 at least

// Units beside those of the other kernels, which bind theirs anew.
layout(binding = 2, r32f) uniform restrict writeonly image2DArray phi_a;
layout(binding = 3, r32f) uniform restrict writeonly image2DArray phi_b;
uniform float band;
uniform float quiet_change;
uniform bool count_step;  // false when codes were only measured

uniform uint constant_steps_before_release;

shared int made[6];
shared float made_of[6];  // the constant that a new page stands for

void grant_request(int face, int number, uint code) {
  made[face] = -1;
  ivec3 across = page_coordinates(number) + kFaceSteps[face];
  if (!contains_page(across)) return;
  int across_number = page_number(across);
  int entry = page_table[across_number];
  // Another page may have asked for the same one.
  if ((code & kAsks << face) == 0u || (entry != kInsidePage && entry != kOutsidePage)) return;
  made[face] = make_resident(across_number, entry);
  made_of[face] = entry == kInsidePage ? band : -band;
}

// Whether everything that touches the faces of a constant page is the same constant.
bool surroundings_are_constant(int number, bool inside) {
  ivec3 coordinates = page_coordinates(number);
  for (int face = 0; face < 6; ++face) {
    ivec3 across = coordinates + kFaceSteps[face];
    if (!contains_page(across)) continue;
    int entry = page_table[page_number(across)];
    if (entry < kFirstPage) {
      if (entry != (inside ? kInsidePage : kOutsidePage)) return false;
      continue;
    }
    uint touching = (inside ? kFaceNotInside : kFaceNotOutside) << (face ^ 1);
    if ((page_state[entry].code & touching) != 0u) return false;
  }
  return true;
}

void give_back_if_constant(int page, uint code) {
  bool inside = (code & kNotInside) == 0u;
  if (!inside && (code & kNotOutside) != 0u) {
    page_state[page].constant_steps = 0u;
    return;
  }
  uint steps = page_state[page].constant_steps + 1u;
  page_state[page].constant_steps = steps;
  if (steps < constant_steps_before_release) return;
  if (surroundings_are_constant(inverse_table[page], inside)) {
    make_free(page, inside ? kInsidePage : kOutsidePage);
  }
}

void main() {
  if (control.step_ran == 0u) return;
  int index = int(gl_LocalInvocationIndex);
  if (work_group() == 0u && index == 0 && count_step) ++control.steps_done;
  // Pages that others list meanwhile are not for the groups that are left over in the last row.
  if (work_group() >= control.active_ready) return;
  int page = active_list[work_group()];
  int number = inverse_table[page];
  if (number < 0) return;
  uint code = page_state[page].code;

  // Most pages need nothing.
  bool asks = (code & kAsks * 63u) != 0u;
  bool moved = page_state[page].change > quiet_change && (page_state[page].flags & kWokeNeighbours) == 0u;
  bool constant = (code & kNotInside) == 0u || (code & kNotOutside) == 0u;
  if (!asks && !moved && !constant) {
    if (index == 0) page_state[page].constant_steps = 0u;
    return;
  }

  if (index < 6) grant_request(index, number, code);
  barrier();
  for (int face = 0; face < 6; ++face) {
    if (made[face] < 0) continue;
    ivec3 origin = page_origin(made[face]);
    for (int i = index; i < kTile.x * kTile.y; i += kInvocations) {
      ivec3 texel = origin + texel_of_tile(i);
      imageStore(phi_a, texel, vec4(made_of[face]));
      imageStore(phi_b, texel, vec4(made_of[face]));
    }
  }

  for (int i = index; moved && i < pages_in_reach(); i += kInvocations) {
    ivec3 other = page_coordinates(number) + step_in_reach(i);
    if (!contains_page(other)) continue;
    int entry = page_table[page_number(other)];
    if (entry >= kFirstPage) wake(entry);
  }
  if (index != 0) return;
  if (moved) atomicOr(page_state[page].flags, kWokeNeighbours);
  give_back_if_constant(page, code);
}
