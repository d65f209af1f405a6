// D that the processor evaluated where it is read (solver/gl/speed_textures.h).

uniform highp isampler3D speed_volume;

const float kSpeedSteps = 32767.0;  // D = 1

float speed_at(ivec3 voxel) { return float(texelFetch(speed_volume, voxel, 0).r) / kSpeedSteps; }
