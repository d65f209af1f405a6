// A sample of a page's motion, first half: 16 voxels to one texel. The largest change over two steps beside the surface,
// the content, and how many voxels are beside the surface (solver/convergence.h).

#include "solver/stream/coordinates.glsl"

uniform sampler2DArray phi_next;
uniform sampler2D central_buffer;  // phi before, in its last channel
uniform float near;

flat in vec2 to_phi;
flat in ivec2 valid_texels;

layout(location = 0) out vec4 motion;

void main() {
  motion = vec4(0.0);
  ivec2 block = ivec2(gl_FragCoord.xy);
  ivec2 first = 4 * (block % 4);  // the block's first texel in the page
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 4; ++x) {
      ivec2 at = ivec2(x, y);
      vec2 here = vec2(4 * block + at) + 0.5;
      float phi = texel_of(phi_next, here * phi_texel + to_phi);
      if (any(greaterThanEqual(first + at, valid_texels))) continue;
      motion.y += clamp(phi, -near, near) + near;
      if (abs(phi) > near) continue;
      float change = abs(phi - textureLod(central_buffer, here * place_texel, 0.0).w);
      motion.x = max(motion.x, change);
      motion.z += 1.0;
    }
  }
}
