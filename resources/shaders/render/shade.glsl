// What a piece of a ray adds to the picture, however the piece was found: the surface where the ray crosses it, the
// source on one side of the surface or on both, the picture on the clip plane.

#include "render/transfer.glsl"
#include "render/lighting.glsl"
#include "render/colours.glsl"

uniform vec3 spacing;           // mm
uniform vec4 surface_colour;    // and opacity, without primitives of its own
uniform int region;             // where the source shows: as enum class Region
uniform bool clip;
uniform vec4 clip_plane;        // in voxel coordinates: hidden where dot(xyz, p) > w
uniform float clip_mm;          // a unit of dot(clip_plane.xyz, p) in mm
uniform vec2 window;            // centre and width, of the clip plane's picture

const int kEverywhere = 0;
const int kInside = 1;
const int kOutside = 2;
const int kTinted = 3;

vec4 result = vec4(0.0);  // premultiplied, front to back

void add(vec3 colour, float opacity) {
  result += (1.0 - result.a) * vec4(colour * opacity, opacity);
}

float distance_from_clip(vec3 p) {
  return clip ? abs(clip_plane.w - dot(clip_plane.xyz, p)) * clip_mm : 0.0;
}

vec4 material_of_surface(vec3 p) {
#if defined(SURFACE_PRIMITIVES) && SURFACE_PRIMITIVES > 0
  return classify_surface(source_between(p), distance_from_clip(p));
#else
  return surface_colour;
#endif
}

// How much of a piece with these phi at its ends the region lets through.
float share_in_region(float phi_a, float phi_b) {
  if (region == kEverywhere || region == kTinted) return 1.0;
  float inside = (phi_a > 0.0) == (phi_b > 0.0) ? (phi_a > 0.0 ? 1.0 : 0.0) : max(phi_a, phi_b) / abs(phi_a - phi_b);
  return region == kInside ? inside : 1.0 - inside;
}

// `material` from classify(); `gradient` of the source in its units a mm.
void add_source(vec4 material, vec3 gradient, vec3 viewer, float phi, float length_mm) {
  vec3 colour = region == kTinted && phi > 0.0 ? mix(material.rgb, surface_colour.rgb, 0.7) : material.rgb;
  add(lit(colour, gradient, viewer, 1.0), 1.0 - exp(-material.a * length_mm));
}

vec3 windowed(float value) {
  return vec3(clamp((value - window.x) / window.y + 0.5, 0.0, 1.0));
}
