#include "solver/paging.glsl"

// What the geometry engine knows of each page that is drawn, for the vertex stage alone: the fragments get addresses
// that are ready to be used (paper section 3.3). The C++ side is solver/stream/geometry_engine.cpp.

uniform isamplerBuffer page_records;
uniform int first_page;     // of the region, in the list of pages
uniform ivec2 target_size;  // of what is drawn into, texels

// A record: the addresses of the 3 x 3 pages of the slice (the page itself in the middle), of the page below and its
// four neighbours, of the page above and its four neighbours, then the first voxel.
const int kRecordLength = 21;
const int kOwnPage = 4;
const int kPageBelow = 11;
const int kPageAbove = 16;
const int kFirstVoxel = 19;

// Pages lie side by side in the intermediate buffers, and in the message.
const int kPlacesPerRow = 32;

int record(int page, int field) { return texelFetch(page_records, page * kRecordLength + field).r; }

// The first texel of a page in G, whose layers follow each other along y.
ivec2 page_address(int page, int field) { return texel_of_page(record(page, field)); }

ivec3 first_voxel(int page) {
  int xy = record(page, kFirstVoxel);
  return ivec3(xy & 0xffff, xy >> 16, record(page, kFirstVoxel + 1));
}

// How many voxels of the page are inside the volume.
ivec2 valid_shape(ivec3 first) { return min(kPageShape.xy, volume_size.xy - first.xy); }

ivec2 place_of(int index) { return ivec2(index % kPlacesPerRow, index / kPlacesPerRow); }

vec4 clip_position(vec2 texel) { return vec4(2.0 * texel / vec2(target_size) - 1.0, 0.0, 1.0); }
const vec4 kNowhere = vec4(2.0, 2.0, 2.0, 1.0);  // clipped
