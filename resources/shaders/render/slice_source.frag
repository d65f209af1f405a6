// A slice of the source, in its own units, and its gradient a voxel: from the slices as they are stored, with the one
// before and the one behind.

#include "render/slice_axes.glsl"

uniform sampler2D stored_before;
uniform sampler2D stored;
uniform sampler2D stored_behind;
uniform vec2 source_scale;  // value = x * texel + y

out vec4 value_and_gradient;

void main() {
  vec2 at = gl_FragCoord.xy / vec2(textureSize(stored, 0));
  const ivec2 u = ivec2(1, 0);
  vec3 gradient;
  gradient.ACROSS = vec2(textureLodOffset(stored, at, 0.0, u.xy).r - textureLodOffset(stored, at, 0.0, -u.xy).r,
                         textureLodOffset(stored, at, 0.0, u.yx).r - textureLodOffset(stored, at, 0.0, -u.yx).r);
  gradient.ALONG = textureLod(stored_behind, at, 0.0).r - textureLod(stored_before, at, 0.0).r;
  float value = source_scale.x * textureLod(stored, at, 0.0).r + source_scale.y;
  value_and_gradient = vec4(value, 0.5 * source_scale.x * gradient);
}
