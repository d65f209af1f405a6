// What happens to a ray on its way, whichever mode draws it: it meets the surface or the clip plane's picture, and the
// clip plane hides a part of it. Needs solver/phi.glsl, render/shade.glsl and render/ray.glsl; with SPEED_COLOURS also
// render/page_state.glsl and render/speed_terms.glsl, and with CHANGE colours it by how far it has moved. With LABELS the labels show in it.

#ifdef LABELS
#include "render/labels.glsl"
#endif

uniform float pixel_mm;
uniform bool clip_surface;
uniform bool clip_source;
uniform bool show_clip_picture;
uniform int colouring;                // as enum class SurfaceColouring
uniform float occlusion;              // how much of the light hollows lose, 0..1

const int kBending = 5;               // of colouring; 1 to 4 are the terms of the speed
const int kActivity = 6;
const int kPickedPlane = 1;
const int kPickedSurface = 2;
const int kPickedSource = 3;
const float kLeastOpacity = 1e-6;
const float kNever = 1e9;

vec2 for_surface = vec2(0.0);         // the parts of the ray in which they may show
vec2 for_source = vec2(0.0);
float cut = kNever;                   // where the clip plane's picture is
vec4 picked = vec4(0.0);

void pick(int kind, vec3 p) {
  if (picked.w == 0.0 && result.a > 0.5) picked = vec4(p, float(kind));
}

// Finds these parts of `whole`, the ray's part in the volume.
void clip_ray(vec2 whole) {
  vec2 left = whole;
#ifdef CLIP
  float slope = dot(clip_plane.xyz, ray_direction);
  float distance_of = clip_plane.w - dot(clip_plane.xyz, ray_start);
  float meets = distance_of / (abs(slope) > 1e-6 ? slope : 1e-6);
  if (abs(slope) <= 1e-6 && distance_of < 0.0) left.y = left.x - 1.0;  // nothing
  if (slope < -1e-6) left.x = max(left.x, meets);
  if (slope > 1e-6) left.y = min(left.y, meets);
  if (show_clip_picture && abs(slope) > 1e-6 && meets >= whole.x && meets < whole.y) cut = meets;
#endif
  for_surface = clip_surface ? left : whole;
  for_source = clip_source ? left : whole;
}

// How open the surface is at p, from what phi is above it: it would be minus the distance above a plain.
float openness(vec3 p, vec3 outward) {
  float unit = min(spacing.x, min(spacing.y, spacing.z));
  float hidden = 0.0;
  for (int i = 1; i <= 3; ++i) {
    float up = 0.25 * float(i) * band;
    hidden += clamp((up + phi_between(p + outward * (up * unit) / spacing)) / up, 0.0, 1.0) / 3.0;
  }
  return 1.0 - occlusion * hidden;
}

#ifdef SPEED_COLOURS
vec3 taught_colour(vec3 p) {
#ifdef CHANGE
  return diverging(evaluated_between(p));
#endif
  ivec3 voxel = clamp(ivec3(floor(p + 0.5)), ivec3(0), volume_size - 1);
  if (colouring == kActivity) return page_colour(page_state(voxel / kPageShape));
  vec2 taught = speed_and_curvature_between(colouring - 1, p, true);
  return diverging(colouring == kBending ? 2.0 * taught.y : taught.x);
}
#endif

#ifdef LABELS
// A label that ends where the surface is colours the surface, as it does in slices; its own border, which is there to
// half a voxel, is not drawn. `inward` is a voxel long.
vec3 coloured_by_label(vec3 colour, vec3 p, vec3 inward) {
  int label = label_between(p + 0.75 * inward);
  bool ends = label != 0 && label_between(p - 0.75 * inward) != label;
  return ends ? mix(colour, colour_of_label(label), label_opacity) : colour;
}

bool surface_is_at(vec3 p) {
#ifdef SURFACE
  vec3 slope = abs(phi_slope(p));
  return surface_colour.a > 0.0 && abs(phi_between(p)) < max(0.75 * max(slope.x, max(slope.y, slope.z)), 0.5);
#else
  return false;
#endif
}

// `slope`: of the label's share, in voxel coordinates.
void add_label(int label, vec3 p, vec3 slope) {
  add(lit(colour_of_label(label), slope / spacing, viewer, 1.0), surface_is_at(p) ? 0.0 : label_opacity);
  pick(kPickedSurface, p);
}
#endif

// `rise`: d phi / d voxel there.
void add_surface(vec3 p, vec3 rise) {
  vec4 material = material_of_surface(p);
#ifdef SPEED_COLOURS
  material.rgb = taught_colour(p);
#elif defined(LABELS)
  material.rgb = coloured_by_label(material.rgb, p, rise / max(length(rise), 1e-6));
#endif
  vec3 slope = rise / spacing;
  float open = 1.0;
#ifdef OCCLUSION
  open = openness(p, -slope / max(length(slope), 1e-6));
#endif
  add(lit(material.rgb, slope, viewer, open), material.a);
  pick(kPickedSurface, p);
}

#ifdef CLIP
// The picture on the clip plane: the source in its window, the surface's cut as a line of constant width.
void add_clip_picture(vec3 p, float phi, vec3 rise) {
  vec3 colour = windowed(source_between(p));
#ifdef LABELS
  int label = label_of(ivec3(floor(p + 0.5)));
  if (label != 0) colour = mix(colour, colour_of_label(label), label_opacity);
#endif
#ifdef SURFACE
  vec3 normal = normalize(clip_plane.xyz / spacing);
  vec3 slope = rise / spacing;
  float steepness = length(slope - normal * dot(slope, normal));
  float pixels = abs(phi) / max(steepness * pixel_mm, 1e-6);
  colour = mix(kOutlineYellow, colour, abs(phi) < band ? smoothstep(0.5, 1.5, pixels) : 1.0);
#endif
  add(colour, 1.0);
  pick(kPickedPlane, p);
}
#endif
