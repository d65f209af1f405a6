// What a page of V_P is at present; needs solver/phi.glsl.

uniform isamplerBuffer page_flags;  // by virtual page: 1 quiet, 2 just made resident

int page_state(ivec3 page) {
  int physical = physical_page(page);
  if (physical < kFirstPage) return physical == kInsidePage ? 1 : 0;
  int flags = texelFetch(page_flags, page_number(page)).r;
  return (flags & 2) != 0 ? 4 : (flags & 1) != 0 ? 3 : 2;
}
