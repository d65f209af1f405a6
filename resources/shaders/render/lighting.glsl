// Blinn-Phong lighting, two-sided.

uniform vec4 light_shares;    // ambient, diffuse, specular; shininess
uniform vec3 light_fixed;     // unit vector to the light, in mm along the voxel axes; 0: the light is at the viewer

// `slope` in units a mm along the voxel axes; `viewer` a unit vector to the viewer; `open` 1 where nothing keeps
// ambient light away.
vec3 lit(vec3 colour, vec3 slope, vec3 viewer, float open) {
  float steepness = length(slope);
  if (steepness < 1e-30) return colour;
  vec3 normal = slope / steepness;
  vec3 light = light_fixed == vec3(0.0) ? viewer : light_fixed;
  float facing = abs(dot(normal, light));
  float mirrored = abs(dot(normal, normalize(light + viewer)));
  return colour * open * (light_shares.x + light_shares.y * facing) + vec3(light_shares.z * open * pow(mirrored, light_shares.w));
}
