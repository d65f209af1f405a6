// D of a voxel: the tent on the source, or with SPEED_VOLUME what the processor evaluated.

#include "solver/volume_blocks.glsl"
#ifdef SPEED_VOLUME
#include "solver/speed/speed_volume.glsl"
#else
#include "solver/source.glsl"
#include "solver/speed/data.glsl"

float speed_at(ivec3 voxel) { return data_speed(source_at(voxel)); }
#endif
