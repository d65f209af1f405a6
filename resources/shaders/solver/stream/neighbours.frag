// Step A of the message (paper section 4.4, figure 8): the two neighbour-information buffers. A texel says with a value
// above 0 what some voxel of a block of 4 x 4 gives notice of; the mean over the page says whether any voxel does.

#include "solver/stream/coordinates.glsl"

uniform sampler2DArray phi_now;
uniform float band;

flat in vec2 to_phi;
flat in vec4 slice_shifts;
flat in vec4 face_shifts[2];  // from a voxel on a face of the page to the one across it: -x and +x, -y and +y
flat in ivec2 valid_texels;

layout(location = 0) out vec4 across_in_slice;  // differs from its neighbour in the page at -x, +x, -y, +y
layout(location = 1) out vec4 across_slices;    // ... at -z, +z; is not inside; is not outside

float phi_at(vec2 position) { return texel_of(phi_now, position); }

void main() {
  ivec2 last = valid_texels - 1;
  ivec2 block = ivec2(gl_FragCoord.xy);
  ivec2 block_in_page = block % 4;
  vec2 first_texel = (vec2(4 * (block - block_in_page)) + 0.5) * phi_texel + to_phi;

  across_slices = vec4(0.0);
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 4; ++x) {
      ivec2 local = min(4 * block_in_page + ivec2(x, y), last);
      vec2 here = first_texel + vec2(local) * phi_texel;
      float phi = phi_at(here);
      across_slices += vec4(notEqual(vec4(phi_at(here + slice_shifts.xy), phi_at(here + slice_shifts.zw), band, -band),
                                     vec4(phi)));
    }
  }

  // The 16 blocks take the 16 voxels of each face.
  ivec2 along = min(ivec2(block_in_page.x + 4 * block_in_page.y), last);
  vec2 on_low_x = first_texel + vec2(0, along.y) * phi_texel;
  vec2 on_high_x = first_texel + vec2(last.x, along.y) * phi_texel;
  vec2 on_low_y = first_texel + vec2(along.x, 0) * phi_texel;
  vec2 on_high_y = first_texel + vec2(along.x, last.y) * phi_texel;
  across_in_slice =
      vec4(notEqual(vec4(phi_at(on_low_x), phi_at(on_high_x), phi_at(on_low_y), phi_at(on_high_y)),
                    vec4(phi_at(on_low_x + face_shifts[0].xy), phi_at(on_high_x + face_shifts[0].zw),
                         phi_at(on_low_y + face_shifts[1].xy), phi_at(on_high_y + face_shifts[1].zw))));
}
