// Step C of the message (paper section 4.4, figure 8): one byte a page. The C++ side is solver/stream/page_message.h.

uniform sampler2D in_slice_buffer;
uniform sampler2D slices_buffer;
uniform sampler2D motion_buffer;
uniform float quiet_change;

flat in ivec2 place;
flat in ivec2 physical_page;

layout(location = 0) out float code;

const int kPageLevel = 2;  // of the mipmaps: one texel a page, from 4 x 4 blocks

void main() {
  vec4 in_slice = texelFetch(in_slice_buffer, place, kPageLevel);
  vec4 slices = texelFetch(slices_buffer, place, kPageLevel);
  vec4 sides = vec4(greaterThan(in_slice, vec4(0.0)));
  float bits = dot(sides, vec4(1.0, 2.0, 4.0, 8.0));
  if (slices.x > 0.0) bits += 16.0;
  if (slices.y > 0.0) bits += 32.0;
  if (slices.z > 0.0 && slices.w > 0.0) {
    bits += 64.0;
    if (texelFetch(motion_buffer, physical_page, 0).x > quiet_change) bits += 128.0;
  } else if (slices.w > 0.0) {
    bits += 128.0;
  }
  code = bits / 255.0;
}
