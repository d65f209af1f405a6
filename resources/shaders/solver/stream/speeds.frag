#include "solver/source.glsl"
#include "solver/stream/differences.glsl"

// Step B (paper section 4.3): the speed terms, each with its weight.

uniform sampler2D upwind_buffer;
uniform sampler2D central_buffer;
uniform sampler2D second_buffer;
uniform sampler2D mixed_buffer;

flat in ivec3 to_voxel;

layout(location = 0) out vec4 speed_terms;

void main() {
  ivec2 texel = ivec2(gl_FragCoord.xy);
  Differences d = unpack(PackedDifferences(
      texelFetch(upwind_buffer, texel, 0), texelFetch(central_buffer, texel, 0),
      texelFetch(second_buffer, texel, 0), texelFetch(mixed_buffer, texel, 0)));
  Speeds s = speeds(d, source_at(ivec3(texel + to_voxel.xy, to_voxel.z)));
  speed_terms = vec4(s.data, s.curvature, s.rescaling, 0.0);
}
