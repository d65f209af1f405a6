#include "solver/stream/page_records.glsl"

// Each page as one point. IN_MEMORY: in a buffer with a texel for each physical page; else in the message, which has a
// texel for each page of the list.

flat out ivec2 place;          // of the page in the region's buffers, counted in pages
flat out ivec2 physical_page;  // its place in G, counted in pages

void main() {
  int page = first_page + gl_VertexID;
  place = place_of(gl_VertexID);
  physical_page = page_address(page, kOwnPage) / kPageShape.xy;
#if defined(IN_MEMORY)
  gl_Position = clip_position(vec2(physical_page) + 0.5);
#else
  gl_Position = clip_position(vec2(place_of(page)) + 0.5);
#endif
}
