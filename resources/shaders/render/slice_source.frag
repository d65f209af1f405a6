// A slice of the source, in its own units, and its gradient a voxel: from the slices as they are stored, with the one
// before and the one behind.

#include "render/slice_axes.glsl"

uniform sampler2D stored_before;
uniform sampler2D stored;
uniform sampler2D stored_behind;
uniform vec2 source_scale;  // value = x * texel + y

out vec4 value_and_gradient;

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  ivec2 last = textureSize(stored, 0) - 1;
  const ivec2 u = ivec2(1, 0);
  vec3 gradient;
  gradient.ACROSS = vec2(texelFetch(stored, min(at + u.xy, last), 0).r - texelFetch(stored, max(at - u.xy, ivec2(0)), 0).r,
                         texelFetch(stored, min(at + u.yx, last), 0).r - texelFetch(stored, max(at - u.yx, ivec2(0)), 0).r);
  gradient.ALONG = texelFetch(stored_behind, at, 0).r - texelFetch(stored_before, at, 0).r;
  value_and_gradient = vec4(source_scale.x * texelFetch(stored, at, 0).r + source_scale.y, 0.5 * source_scale.x * gradient);
}
