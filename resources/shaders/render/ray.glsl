// A ray through the volume, and the page that it is in. A unit of t is a voxel.

vec3 ray_start = vec3(0.0);      // voxel coordinates
vec3 ray_direction = vec3(0.0);  // length 1
vec3 ray_inverse = vec3(0.0);
float ray_mm = 1.0;              // a unit of t in mm
vec3 viewer = vec3(0.0);         // unit vector to the viewer, in mm along the voxel axes

// The page at t, set by enter_page().
ivec3 page = ivec3(0);
int physical = 0;
float page_end = 0.0;

vec3 on_ray(float t) {
  return ray_start + t * ray_direction;
}

// Returns where the ray enters and leaves the volume.
vec2 begin_ray(mat4 voxel_from_view, vec2 view_position, vec3 spacing) {
  vec4 a = voxel_from_view * vec4(view_position, -1.0, 1.0);
  vec4 b = voxel_from_view * vec4(view_position, 1.0, 1.0);
  ray_start = a.xyz / a.w;
  vec3 way = b.xyz / b.w - ray_start;
  ray_direction = way / length(way);
  ray_mm = length(ray_direction * spacing);
  viewer = -ray_direction * spacing / ray_mm;
  ray_inverse = 1.0 / (ray_direction + vec3(equal(ray_direction, vec3(0.0))) * 1e-9);
  vec3 to_low = (vec3(-0.5) - ray_start) * ray_inverse;
  vec3 to_high = (vec3(volume_size) - 0.5 - ray_start) * ray_inverse;
  vec3 enter = min(to_low, to_high);
  vec3 leave = max(to_low, to_high);
  return vec2(max(max(enter.x, max(enter.y, enter.z)), 0.0), min(leave.x, min(leave.y, leave.z)));
}

// The normal of the volume's face that p is on, in mm.
vec3 face_at(vec3 p) {
  vec3 to_face = min(abs(p + 0.5), abs(p - (vec3(volume_size) - 0.5)));
  return vec3(lessThanEqual(to_face, vec3(min(to_face.x, min(to_face.y, to_face.z)) + 1e-3)));
}

// The page that the ray is in just behind t, and where it leaves it.
void enter_page(float t) {
  vec3 p = on_ray(t + 1e-3);
  page = clamp(ivec3(p + 0.5) / kPageShape, ivec3(0), page_grid - 1);
  vec3 low = vec3(page * kPageShape) - 0.5;
  vec3 out_of = max((low - ray_start) * ray_inverse, (low + vec3(kPageShape) - ray_start) * ray_inverse);
  page_end = max(min(out_of.x, min(out_of.y, out_of.z)), t + 1e-3);
  physical = physical_page(page);
}

// phi of the voxel nearest to the ray at t, which is in the page entered.
float nearest_phi(float t) {
  ivec3 voxel = clamp(ivec3(floor(on_ray(t) + 0.5)), page * kPageShape, min((page + 1) * kPageShape, volume_size) - 1);
  return phi_in(physical, voxel - page * kPageShape);
}
