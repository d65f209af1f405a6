// The source volume, in its own units. SOURCE_SAMPLER is the sampler that fits its stored type. With SOURCE_BLOCKS it is in
// blocks, where the driver has no texture so large.

#include "solver/volume_blocks.glsl"

uniform highp SOURCE_SAMPLER source_volume;
#ifdef SOURCE_BLOCKS
uniform highp isampler3D source_table;
#endif
uniform float source_slope;
uniform float source_intercept;

float source_at(ivec3 voxel) {
#ifdef SOURCE_BLOCKS
  voxel = texel_in_blocks(source_table, voxel);
#endif
  return source_slope * float(texelFetch(source_volume, voxel, 0).r) + source_intercept;
}
