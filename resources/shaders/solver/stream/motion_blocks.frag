// Motion over two steps, first half: 16 voxels to one texel. Largest and squared change, and how many voxels there are,
// beside the surface.

uniform sampler2D phi_next;
uniform sampler2D central_buffer;  // phi before, in its last channel
uniform float near;

flat in ivec2 to_phi;
flat in ivec2 to_place;
flat in ivec2 valid_texels;

layout(location = 0) out vec4 motion;

void main() {
  ivec2 block = ivec2(gl_FragCoord.xy);
  motion = vec4(0.0);
  // `to_phi` and `to_place` lead from a page's first block to its first texel.
  ivec2 first_block = block - (block % 4);
  ivec2 first = 4 * (block - first_block);
  ivec2 in_phi = first_block + to_phi + first;
  ivec2 in_place = first_block + to_place + first;
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 4; ++x) {
      ivec2 at = ivec2(x, y);
      float phi = texelFetch(phi_next, in_phi + at, 0).r;
      if (abs(phi) > near || any(greaterThanEqual(first + at, valid_texels))) continue;
      float change = abs(phi - texelFetch(central_buffer, in_place + at, 0).w);
      motion = vec4(max(motion.x, change), motion.y + change * change, motion.z + 1.0, 0.0);
    }
  }
}
