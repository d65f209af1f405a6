// The speed terms of a voxel, from what drives the surface there. With ADVECTION there is a velocity beside D.

#include "solver/speed/update.glsl"
#include "solver/speed/voxel_speed.glsl"
#ifdef ADVECTION
#include "solver/speed/advection.glsl"
#endif

Speeds speeds_at(ivec3 voxel, Differences d) {
  Speeds s = speeds(d, speed_at(voxel));
#ifdef ADVECTION
  s.advection = advection_speed(d, velocity_at(voxel));
#endif
  return s;
}
