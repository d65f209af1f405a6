// D that the processor evaluated where it is read (solver/gl/speed_textures.h).

#include "solver/volume_blocks.glsl"

uniform highp isampler2DArray speed_blocks;
uniform highp isampler3D speed_table;

const float kSpeedSteps = 32767.0;  // D = 1

float speed_at(ivec3 voxel) {
  return float(texelFetch(speed_blocks, texel_in_blocks(speed_table, voxel), 0).r) / kSpeedSteps;
}
