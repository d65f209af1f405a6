// The source volume, in its own units. SOURCE_SAMPLER is the sampler that fits its stored type.

uniform highp SOURCE_SAMPLER source_volume;
uniform float source_slope;
uniform float source_intercept;

float source_at(ivec3 voxel) {
  return source_slope * float(texelFetch(source_volume, voxel, 0).r) + source_intercept;
}
