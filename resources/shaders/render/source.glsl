// The source volume, filtered by the hardware.

uniform sampler3D source_values;
uniform vec2 source_scale;  // value = x * texel + y

// `position` in voxel coordinates, integers at voxel centres.
float source_between(vec3 position) {
  return source_scale.x * texture(source_values, (position + 0.5) / vec3(volume_size)).r + source_scale.y;
}
