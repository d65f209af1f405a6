// phi and the source between the two slices that are cached at present: the hardware filters in them, and what is between
// them is linear along the axis.

#include "render/slice_axes.glsl"

uniform sampler2D phi_front;     // phi and d phi / d voxel
uniform sampler2D phi_back;
uniform sampler2D source_front;  // the source and its gradient a voxel
uniform sampler2D source_back;
uniform float front_slice;       // voxel coordinate along the axis
uniform float back_slice;

vec4 between_slices(sampler2D front, sampler2D back, vec3 p) {
  vec2 at = (p.ACROSS + 0.5) / vec2(volume_size.ACROSS);
  float share = front_slice == back_slice ? 0.0 : (p.ALONG - front_slice) / (back_slice - front_slice);
  // Exactly a slice's where a ray passes it, so that the slabs before and behind agree on which side of the surface it is.
  share = clamp(1.002 * share - 0.001, 0.0, 1.0);
  return mix(textureLod(front, at, 0.0), textureLod(back, at, 0.0), share);
}

float source_between(vec3 p) {
  return between_slices(source_front, source_back, p).r;
}
