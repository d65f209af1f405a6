// The virtual memory as compute shaders keep it: page table, inverse page table, free list, and what is known of
// each physical page.

#include "solver/paging.glsl"

layout(std430, binding = 0) coherent buffer PageTable { int page_table[]; };       // V_P -> G_P
layout(std430, binding = 1) coherent buffer InverseTable { int inverse_table[]; }; // G_P -> V_P; -1: free

// Of a physical page.
struct PageState {
  uint flags;
  uint code;            // of its newest phi, kCode* below
  uint constant_steps;  // for how many maintenances it has been constant
  uint samples;         // of a window, in near_voxels and content (solver/convergence.h, PageContent)
  uint near_voxels;
  float change;         // the sum of the largest changes beside the surface since the window began
  float content;
  float anchor;         // as PageRest has them
  int since;
  int moved;
};
layout(std430, binding = 2) coherent buffer PageStates { PageState page_state[]; };

// What the processor reads back after a run of steps, and what the dispatches of a run hand on.
layout(std430, binding = 3) coherent buffer Control {
  uvec3 active_groups;  // work groups for the active pages: dispatch arguments
  uint active_ready;    // entries of the active list when the step began
  uint active_count;    // entries of the active list
  uint steps_done;      // since the run began
  uint starved;         // a page was asked for and none was free
  uint converged;
  uint stop_at_convergence;
  uint free_head;       // the free list is a ring: [free_head, free_tail)
  uint free_tail;
  uint free_tail_ready; // entries before this were there when the dispatch began
  uvec2 voxel_updates;  // 64 bits, low word first
  uint quiet_pages;
  int window;             // the present one, and the first that counts
  int first_window;
  uint moving_so_far;     // of the pages that were judged at the window's end
  uint speed_so_far;      // a float's bits
  uint moving_pages;      // in the last full window
  float surface_speed;
  uint step_ran;          // 0 when the run has ended before this step
  uint list_is_rebuilt;   // 0 when the window's end is not to be judged
  uint pages_wanted;      // that a sphere needs
} control;

layout(std430, binding = 4) coherent buffer ActiveList { int active_list[]; };
layout(std430, binding = 5) coherent buffer FreeList { int free_list[]; };

const uint kAsleep = 1u;        // quiet: not computed, both buffers are equal
const uint kListed = 2u;        // in the active list, perhaps as a page that has been freed since
const uint kFallsAsleep = 4u;   // judged quiet in this window
const uint kWokeNeighbours = 8u;

// Bits of a page's code. Faces: -x, +x, -y, +y, -z, +z.
const uint kFaceNotInside = 1u;       // << face: near that face a voxel is not W
const uint kFaceNotOutside = 1u << 6; // << face: near that face a voxel is not -W
const uint kNotInside = 1u << 12;     // a voxel is not W
const uint kNotOutside = 1u << 13;    // a voxel is not -W
const uint kAsks = 1u << 14;          // << face: the page across that face must become resident

// A page table entry while a page is being made for it.
const int kClaimed = -1;

// Lists of more groups than this are wrapped into rows: a dispatch may be no longer along x.
const uint kGroupsPerRow = 32768u;

uniform uint first_group;  // where a long list is dispatched in several pieces

uint work_group() {
  return first_group + gl_WorkGroupID.x + kGroupsPerRow * gl_WorkGroupID.y;
}

void add_to_active_list(int page) {
  uint old = atomicOr(page_state[page].flags, kListed);
  if ((old & kListed) != 0u) return;
  uint index = atomicAdd(control.active_count, 1u);
  active_list[index] = page;
  atomicMax(control.active_groups.x, min(index + 1u, kGroupsPerRow));
  atomicMax(control.active_groups.y, index / kGroupsPerRow + 1u);
}

void begin_samples(int page) {
  page_state[page].samples = 0u;
  page_state[page].near_voxels = 0u;
  page_state[page].change = 0.0;
  page_state[page].content = 0.0;
}

void wake(int page) {
  uint old = atomicAnd(page_state[page].flags, ~kAsleep);
  if ((old & kAsleep) != 0u) add_to_active_list(page);
}

// Makes a page of V_P that is not resident resident; its voxels are the caller's to write. Returns the physical page,
// or -1 when somebody else is making it or none is free.
int make_resident(int number, int constant) {
  if (atomicCompSwap(page_table[number], constant, kClaimed) != constant) return -1;
  uint place = atomicAdd(control.free_head, 1u);
  if (int(control.free_tail_ready - place) <= 0) {
    atomicAdd(control.free_head, ~0u);
    atomicExchange(page_table[number], constant);
    atomicExchange(control.starved, 1u);
    return -1;
  }
  int page = free_list[place % uint(free_list.length())];
  inverse_table[page] = number;
  atomicAnd(page_state[page].flags, kListed);
  // Until its first step it counts as a page that cannot be given back.
  page_state[page].code = kNotInside | kNotOutside | (constant == kInsidePage ? 63u << 6 : 63u);
  page_state[page].constant_steps = 0u;
  begin_samples(page);
  page_state[page].since = page_state[page].moved = -1;
  add_to_active_list(page);
  atomicExchange(page_table[number], page);
  return page;
}

void make_free(int page, int constant) {
  atomicExchange(page_table[inverse_table[page]], constant);
  inverse_table[page] = -1;
  atomicAnd(page_state[page].flags, kListed);
  uint place = atomicAdd(control.free_tail, 1u);
  free_list[place % uint(free_list.length())] = page;
}

const ivec3 kFaceSteps[6] =
    ivec3[6](ivec3(-1, 0, 0), ivec3(1, 0, 0), ivec3(0, -1, 0), ivec3(0, 1, 0), ivec3(0, 0, -1), ivec3(0, 0, 1));

// How many pages away along each axis the surface can be whose distance a page's voxels hold: so far a page's motion
// keeps others awake.
uniform ivec3 quiet_reach;

int pages_in_reach() {
  ivec3 width = 2 * quiet_reach + 1;
  return width.x * width.y * width.z;
}
ivec3 step_in_reach(int index) {
  ivec3 width = 2 * quiet_reach + 1;
  return ivec3(index % width.x, index / width.x % width.y, index / (width.x * width.y)) - quiet_reach;
}

// The step to neighbour `index` of 27; 13 is the page itself.
ivec3 neighbour_step(int index) {
  return ivec3(index % 3, index / 3 % 3, index / 9) - 1;
}
