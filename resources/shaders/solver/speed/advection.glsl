// The advection term -v . grad phi (paper eq. 1): each axis takes the difference from where the flow comes.

// v of the voxels, along the axes of the grid, in units of the smallest spacing per unit of time.
uniform highp sampler2DArray velocity_blocks;  // beside those of D

vec3 velocity_at(ivec3 voxel) { return texelFetch(velocity_blocks, texel_in_blocks(speed_table, voxel), 0).xyz; }

// What the flow adds to phi in a unit of time. The one-sided differences are half the sum and half the difference of
// the central and the second ones.
float advection_speed(Differences d, vec3 velocity) {
  vec3 second = d.second;
#ifdef ANISOTROPIC
  second /= inverse_spacing;
#endif
  vec3 behind = 0.5 * (d.two_central - second);
  vec3 ahead = 0.5 * (d.two_central + second);
  vec3 motion = max(velocity, 0.0) * behind + min(velocity, 0.0) * ahead;
  return -(motion.x + motion.y + motion.z);
}
