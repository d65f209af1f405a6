#include "solver/compute/page_memory.glsl"

// phi in and around a page, which a work group computes: the address modes of the update.
//
// An invocation computes DEPTH slices of a block of BLOCK columns along z that lie side by side along y. With SHARED_APRON
// the page and the voxels around it are brought to shared memory first, and a block is one column, in short pieces: a
// GPU's way. Otherwise each invocation fetches what its whole block needs, and a larger block needs fewer fetches a
// voxel: the way of a processor that plays the GPU.
//
// FOR_ROWS(F) is F(0) F(1) ... for the columns of a block and one more on each side: written out, because software
// drivers do not unroll such loops and then index registers through memory.

const int kInvocations = PAGE_X * (PAGE_Y / BLOCK) * (PAGE_Z / DEPTH);

uniform sampler2DArray phi_now;

shared int neighbours[27];

// Of the page.
ivec3 origin = ivec3(0);
ivec3 first_voxel = ivec3(0);
ivec3 lowest = ivec3(0);   // the least and the greatest local coordinate with a voxel of its own, -1..PAGE
ivec3 highest = ivec3(0);
ivec3 last = ivec3(0);     // the last voxel of the page that is inside the volume

ivec2 block_start = ivec2(0);  // the block's first column in the page
int first_slice = 0;           // that the invocation computes

void find_neighbours(int page) {
  ivec3 coordinates = page_coordinates(inverse_table[page]);
  origin = page_origin(page);
  first_voxel = coordinates * kPageShape;
  lowest = -ivec3(greaterThan(first_voxel, ivec3(0)));
  highest = min(kPageShape, volume_size - 1 - first_voxel);
  last = min(kPageShape - 1, highest);
  for (int i = int(gl_LocalInvocationIndex); i < 27; i += kInvocations) {
    ivec3 other = coordinates + neighbour_step(i);
    neighbours[i] = contains_page(other) ? page_table[page_number(other)] : page;
  }
}

// Which page along an axis a local coordinate is in: -1, 0 or 1.
ivec3 page_step(ivec3 local) {
  return ivec3(greaterThanEqual(local, kPageShape)) - ivec3(lessThan(local, ivec3(0)));
}

// phi in and around the block in a slice: three values along x for each row, from y - 1 on.
#define SLICE_VALUES (3 * (BLOCK + 2))

#ifdef SHARED_APRON
const ivec3 kApron = kPageShape + 2;
shared float apron[kApron.x * kApron.y * kApron.z];

void gather_apron() {
  const int kColumns = kApron.x * kApron.y;
  for (int i = int(gl_LocalInvocationIndex); i < kColumns; i += kInvocations) {
    // Neumann at the volume's border.
    ivec2 place = clamp(ivec2(i % kApron.x, i / kApron.x) - 1, lowest.xy, highest.xy);
    ivec2 step = page_step(ivec3(place, 0)).xy;
    int column = 13 + step.x + 3 * step.y;
    ivec3 before = page_origin(neighbours[column - 9]);
    ivec3 here = page_origin(neighbours[column]);
    ivec3 behind = page_origin(neighbours[column + 9]);
    place -= step * kPageShape.xy;
    for (int z = -1; z <= PAGE_Z; ++z) {
      int inside = clamp(z, lowest.z, highest.z);
      ivec3 page = inside < 0 ? before : inside >= PAGE_Z ? behind : here;
      int slice = inside < 0 ? PAGE_Z - 1 : inside >= PAGE_Z ? 0 : inside;
      apron[i + kColumns * (z + 1)] = texelFetch(phi_now, page + texel_in_page(ivec3(place, slice)), 0).r;
    }
  }
}
void load_slice(int z, out float slice[SLICE_VALUES]) {
  int first = block_start.x + kApron.x * (block_start.y + kApron.y * (z + 1));
#define LOAD_ROW(row)                                \
  slice[3 * row] = apron[first + kApron.x * row];         \
  slice[3 * row + 1] = apron[first + kApron.x * row + 1]; \
  slice[3 * row + 2] = apron[first + kApron.x * row + 2];
  FOR_ROWS(LOAD_ROW)
}
#else
// The texels at which columns begin in the page that is being walked along z: at x - 1, x and x + 1, each before the
// block, at its first column and behind it.
ivec3 column_start[9];

void find_columns(int page_along_z) {
  for (int i = 0; i < 9; ++i) {
    ivec2 place = block_start + ivec2(i % 3 - 1, i / 3 == 0 ? -1 : i / 3 == 1 ? 0 : BLOCK);
    ivec3 voxel = clamp(ivec3(place, 0), lowest, highest);  // Neumann at the volume's border
    ivec3 step = page_step(voxel);
    ivec3 page = page_origin(neighbours[13 + step.x + 3 * step.y + 9 * page_along_z]);
    column_start[i] = page + texel_in_page(ivec3(voxel.xy - step.xy * kPageShape.xy, 0));
  }
}
void load_row(int row, ivec3 shift, inout float slice[SLICE_VALUES]) {
  int part = row == 0 ? 0 : row == BLOCK + 1 ? 2 : 1;
  // Rows of the block beyond the volume repeat its last row.
  ivec3 texel = shift + texel_in_page(ivec3(0, part == 1 ? clamp(highest.y - block_start.y, 0, row - 1) : 0, 0));
  slice[3 * row] = texelFetch(phi_now, column_start[3 * part] + texel, 0).r;
  slice[3 * row + 1] = texelFetch(phi_now, column_start[3 * part + 1] + texel, 0).r;
  slice[3 * row + 2] = texelFetch(phi_now, column_start[3 * part + 2] + texel, 0).r;
}
void load_slice(int z, out float slice[SLICE_VALUES]) {
  int inside = clamp(z, lowest.z, highest.z);
  int page_along_z = inside < 0 ? -1 : inside >= PAGE_Z ? 1 : 0;
  // At the volume's end the last slice is read again, and the columns stay.
  if (z == -1 || z == 0 || z == PAGE_Z) find_columns(page_along_z);
  ivec3 shift = texel_in_page(ivec3(0, 0, inside - page_along_z * PAGE_Z));
#define LOAD_ROW(row) load_row(row, shift, slice);
  FOR_ROWS(LOAD_ROW)
}
#endif
