#include "solver/stream/page_records.glsl"
#include "solver/stream/coordinates.glsl"

// The geometry engine (paper section 3.4): pages as primitives, and the whole translation of addresses.
//
// INTERIOR, EDGES, CORNERS: the nine substreams, as a quad, four lines and four points a page.
// WHOLE: the page as one quad. QUARTERS: likewise, in a buffer of a quarter of the size.
// IN_MEMORY: drawn into a layer of G, else into the intermediate buffers.
// NEIGHBOURS: with the addresses of the neighbours, which for QUARTERS are those across the faces of the page.

#ifdef IN_MEMORY
uniform int target_layer;
#endif

flat out vec2 to_phi;       // from the texel that is drawn to the same voxel's in G, in G's texture coordinates
flat out vec2 to_place;     // ... in the intermediate buffers, in theirs
flat out ivec3 to_voxel;    // ... in the volume
flat out ivec2 valid_texels;

#if defined(INTERIOR) || defined(WHOLE) || defined(QUARTERS)
const int kVertices = 6;
#elif defined(EDGES)
const int kVertices = 8;
#else
const int kVertices = 4;
#endif

// Where a vertex lies in a page with `valid` texels; `local` is a texel of its substream. Returns false when the page
// has no such substream.
#if defined(EDGES)
// By the diamond-exit rule a line lights the texel in whose middle it starts, and not the one in whose middle it ends.
bool place_vertex(int vertex, ivec2 valid, out vec2 at, out ivec2 local) {
  int line = vertex / 2;
  bool horizontal = line < 2;
  int across = (line % 2 == 0 ? 0 : (horizontal ? valid.y : valid.x) - 1);
  int along = vertex % 2 == 0 ? 1 : (horizontal ? valid.x : valid.y) - 1;
  at = (horizontal ? vec2(along, across) : vec2(across, along)) + 0.5;
  local = horizontal ? ivec2(1, across) : ivec2(across, 1);
  return (horizontal ? valid.x : valid.y) > 2 && (line % 2 == 0 || across > 0);
}
#elif defined(CORNERS)
bool place_vertex(int vertex, ivec2 valid, out vec2 at, out ivec2 local) {
  ivec2 corner = ivec2(vertex % 2, vertex / 2);
  local = corner * (valid - 1);
  at = vec2(local) + 0.5;
  return all(lessThanEqual(corner, valid - 1));
}
#else
bool place_vertex(int vertex, ivec2 valid, out vec2 at, out ivec2 local) {
  ivec2 corner = ivec2(vertex == 1 || vertex == 2 || vertex == 4, vertex == 2 || vertex == 4 || vertex == 5);
  local = ivec2(1);
#if defined(INTERIOR)
  at = vec2(1 + corner * (valid - 2));
  return all(greaterThan(valid, ivec2(2)));
#elif defined(QUARTERS)
  at = vec2(corner * (kPageShape.xy / 4));
  return true;
#else
  at = vec2(corner * valid);
  return true;
#endif
}
#endif

#ifdef NEIGHBOURS
#if defined(INTERIOR) || defined(QUARTERS)
flat out vec4 slice_shifts;  // to the voxel below, and to the one above, in G's texture coordinates
#endif
#if defined(QUARTERS)
flat out vec4 face_shifts[2];  // from a voxel on a face to the one across it: -x and +x, -y and +y
#elif !defined(INTERIOR)
flat out vec4 shifts[9];  // to two neighbours each, in the order of Stencil
#endif

// From a voxel to its neighbour, in G; clamped at the volume's border. `local` is the voxel's place in the page.
vec2 shift_to(int page, ivec3 first, ivec2 own, ivec2 local, ivec3 direction) {
  ivec2 lowest = -ivec2(greaterThan(first.xy, ivec2(0)));
  ivec2 highest = min(kPageShape.xy, volume_size.xy - 1 - first.xy);
  ivec2 there = clamp(local + direction.xy, lowest, highest);
  ivec2 step = ivec2(greaterThanEqual(there, kPageShape.xy)) - ivec2(lessThan(there, ivec2(0)));
  int field = direction.z == 0 ? kOwnPage + step.x + 3 * step.y
                               : (direction.z < 0 ? kPageBelow : kPageAbove) + step.x + 2 * step.y;
  return vec2(page_address(page, field) + there - step * kPageShape.xy - own - local) * phi_texel;
}

const ivec3 kDirections[18] = ivec3[18](
    ivec3(-1, 0, 0), ivec3(1, 0, 0), ivec3(0, -1, 0), ivec3(0, 1, 0), ivec3(0, 0, -1), ivec3(0, 0, 1),
    ivec3(-1, -1, 0), ivec3(-1, 1, 0), ivec3(1, -1, 0), ivec3(1, 1, 0),
    ivec3(-1, 0, -1), ivec3(-1, 0, 1), ivec3(1, 0, -1), ivec3(1, 0, 1),
    ivec3(0, -1, -1), ivec3(0, -1, 1), ivec3(0, 1, -1), ivec3(0, 1, 1));
#endif

void main() {
  int index = gl_VertexID / kVertices;
  int page = first_page + index;
  ivec3 first = first_voxel(page);
  ivec2 own = page_address(page, kOwnPage);
  ivec2 place = place_of(index) * kPageShape.xy;
  vec2 at;
  ivec2 local;
  valid_texels = valid_shape(first);
  bool drawn = place_vertex(gl_VertexID % kVertices, valid_texels, at, local);

#if defined(IN_MEMORY)
  ivec2 origin = own - ivec2(0, target_layer * kLayerHeight);
  drawn = drawn && own.y / kLayerHeight == target_layer;
#elif defined(QUARTERS)
  ivec2 origin = place / 4;
#else
  ivec2 origin = place;
#endif
#if defined(QUARTERS)
  const int kTexelsAlong = 4;  // that a drawn texel stands for
#else
  const int kTexelsAlong = 1;
#endif
  gl_Position = drawn ? clip_position(vec2(origin) + at) : kNowhere;
  to_phi = vec2(own - kTexelsAlong * origin) * phi_texel;
  to_place = vec2(place - kTexelsAlong * origin) * place_texel;
  to_voxel = ivec3(first.xy - origin, first.z);
#ifdef NEIGHBOURS
#if defined(INTERIOR) || defined(QUARTERS)
  slice_shifts = vec4(page_address(page, kPageBelow) - own, page_address(page, kPageAbove) - own) * phi_texel.xyxy;
#endif
#if defined(QUARTERS)
  ivec2 last = valid_texels - 1;
  face_shifts[0] = vec4(shift_to(page, first, own, ivec2(0), kDirections[0]),
                        shift_to(page, first, own, last, kDirections[1]));
  face_shifts[1] = vec4(shift_to(page, first, own, ivec2(0), kDirections[2]),
                        shift_to(page, first, own, last, kDirections[3]));
#elif !defined(INTERIOR)
  for (int i = 0; i < 9; ++i) {
    shifts[i] = vec4(shift_to(page, first, own, local, kDirections[2 * i]),
                     shift_to(page, first, own, local, kDirections[2 * i + 1]));
  }
#endif
#endif
}
