// The source volume, filtered by the hardware.

uniform sampler3D source_values;
uniform vec2 source_scale;  // value = x * texel + y
uniform vec3 source_unit;   // a voxel in texture coordinates

// `position` in voxel coordinates, integers at voxel centres.
float source_between(vec3 position) {
  return source_scale.x * textureLod(source_values, (position + 0.5) * source_unit, 0.0).r + source_scale.y;
}

// The source's gradient at p, in its units a mm. FAST_GRADIENT: from differences to one side, with its value `there`.
vec3 source_gradient(vec3 p, vec3 spacing, float there) {
  const vec2 h = vec2(1.0, 0.0);
#ifdef FAST_GRADIENT
  return (vec3(source_between(p + h.xyy), source_between(p + h.yxy), source_between(p + h.yyx)) - there) / spacing;
#else
  return 0.5 / spacing * vec3(source_between(p + h.xyy) - source_between(p - h.xyy),
                              source_between(p + h.yxy) - source_between(p - h.yxy),
                              source_between(p + h.yyx) - source_between(p - h.yyx));
#endif
}
