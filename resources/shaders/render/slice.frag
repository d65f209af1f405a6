// A slice through the volume: the source in its window, the surface as a line of constant width, or the speed map.

#include "solver/phi.glsl"
#include "render/source.glsl"
#include "solver/speed/data.glsl"

in vec2 view_position;
out vec4 fragment;

uniform mat4 voxel_from_view;
uniform vec2 window;          // centre and width
uniform vec3 spacing;         // mm
uniform int content;          // 0 source, 1 speed D(I), 2 pages
uniform bool nearest;
uniform bool show_surface;
uniform float line_pixels;
uniform vec3 background;

// Diverging, told apart by colour-blind people, too: blue where the surface shrinks, orange where it grows.
vec3 diverging(float x) {
  vec3 cold = vec3(0.13, 0.36, 0.67), warm = vec3(0.80, 0.40, 0.05), middle = vec3(0.95);
  return x < 0.0 ? mix(middle, cold, min(-x, 1.0)) : mix(middle, warm, min(x, 1.0));
}

void main() {
  vec4 at = voxel_from_view * vec4(view_position, 0.0, 1.0);
  vec3 p = at.xyz / at.w;
  bool outside = any(lessThan(p, vec3(-0.5))) || any(greaterThan(p, vec3(volume_size) - 0.5));
  float value = source_between(nearest ? round(p) : p);
  vec3 colour = vec3(clamp((value - window.x) / window.y + 0.5, 0.0, 1.0));
  float phi = phi_between(p);
  float phi_slope_in_view = length(vec2(dFdx(phi), dFdy(phi)));

  if (content == 1) {
    float speed = data_speed(value);
    float slope = length(vec2(dFdx(speed), dFdy(speed)));
    colour = diverging(speed);
    // Hatching where it shrinks, so that the sign needs no colour.
    if (speed < 0.0 && mod(gl_FragCoord.x + gl_FragCoord.y, 8.0) < 1.5) colour *= 0.75;
    if (abs(speed) < 0.7 * slope) colour = vec3(0.1);
  } else if (content == 2) {
    ivec3 voxel = clamp(ivec3(round(p)), ivec3(0), volume_size - 1);
    ivec3 page = voxel / kPageShape;
    int physical = physical_page(page);
    vec3 tint = physical >= kFirstPage ? vec3(0.20, 0.55, 0.85) : physical == kInsidePage ? vec3(0.9, 0.75, 0.3) : vec3(0.35);
    colour = mix(colour, tint, physical >= kFirstPage ? 0.45 : 0.2);
    vec3 in_page = (p + 0.5) / vec3(kPageShape);
    vec3 width = fwidth(in_page);
    vec3 edge = abs(in_page - round(in_page));
    if (physical >= kFirstPage && any(lessThan(edge, 0.6 * width))) colour = mix(colour, vec3(1.0), 0.5);
  }
  if (show_surface && abs(phi) < band) {
    // Where the slice grazes the surface phi hardly changes in it; the line must not become a patch.
    float pixel = length(dFdx(p) * spacing) / min(spacing.x, min(spacing.y, spacing.z));
    float pixels = abs(phi) / max(phi_slope_in_view, 0.4 * pixel);
    colour = mix(vec3(1.0, 0.85, 0.0), colour, smoothstep(0.5 * line_pixels - 0.5, 0.5 * line_pixels + 0.5, pixels));
  }
  fragment = vec4(outside ? background : colour, 1.0);
}
