// A sample of a page's motion, second half: 16 blocks to one texel a page, added to the samples of the window so far.

uniform sampler2D block_buffer;

flat in ivec2 place;

layout(location = 0) out vec4 motion;

void main() {
  motion = vec4(0.0, 0.0, 0.0, 1.0);
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 4; ++x) {
      vec4 block = texelFetch(block_buffer, 4 * place + ivec2(x, y), 0);
      motion = vec4(max(motion.x, block.x), motion.yz + block.yz, motion.w);
    }
  }
}
