#include "solver/stream/coordinates.glsl"
#include "solver/stream/differences.glsl"
#include "solver/speed/voxel_speeds.glsl"

// Step B (paper section 4.3): the speed terms, each with its weight.

uniform sampler2D upwind_buffer;
uniform sampler2D central_buffer;
uniform sampler2D second_buffer;
uniform sampler2D mixed_buffer;

flat in ivec3 to_voxel;

layout(location = 0) out vec4 speed_terms;

void main() {
  vec2 here = gl_FragCoord.xy * place_texel;
  Differences d = unpack(PackedDifferences(
      textureLod(upwind_buffer, here, 0.0), textureLod(central_buffer, here, 0.0),
      textureLod(second_buffer, here, 0.0), textureLod(mixed_buffer, here, 0.0)));
  Speeds s = speeds_at(ivec3(ivec2(gl_FragCoord.xy) + to_voxel.xy, to_voxel.z), d);
  speed_terms = vec4(s.data, s.curvature, s.rescaling, s.advection);
}
