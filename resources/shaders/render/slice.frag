// A slice through the volume: the source in its window, perhaps with further images over it (IMAGES), the speed (SPEED) or
// its data term alone (DATA_SPEED), its doubt (DOUBT), or the pages (PAGES); what the surface has won and lost (CHANGE),
// labels, walls and anchors (CONSTRAINED), contours of phi and the surface's outline over it. These are variants, not uniforms: a driver that
// computes both sides of every branch would work out the speed for every picture.

#include "solver/phi.glsl"
#include "solver/volume_blocks.glsl"
#ifdef SOURCE_PLANE
#include "render/source_plane.glsl"
#else
#include "render/source.glsl"
#endif
#ifdef SPEED_VOLUME
#include "render/evaluated_map.glsl"
#endif
#if defined(SPEED) || defined(DATA_SPEED)
#include "render/speed_terms.glsl"
#endif
#ifdef PAGES
#include "render/page_state.glsl"
#endif
#include "render/colours.glsl"
#ifdef CONSTRAINED
#include "render/constraints.glsl"
#endif

in vec2 view_position;
out vec4 fragment;

uniform mat4 voxel_from_view;
uniform vec2 window;          // centre and width
uniform vec3 spacing;         // mm
uniform int term;             // of SPEED, as enum class SpeedTerm
uniform bool nearest;
uniform bool show_surface;
uniform bool show_contours;
uniform float line_pixels;
uniform usampler2DArray labels;  // 0: nothing
uniform isampler3D label_table;
uniform float label_opacity;  // 0 without labels
uniform sampler2D label_colours;  // by label, 256 in a row; opacity 0 for those that are hidden
uniform vec3 background;
#ifdef IMAGES
uniform sampler2D images;   // colours times opacity; its first row is the picture's top
uniform float images_from;  // the part of the picture's width left of which there are none

vec3 with_images(vec3 below) {
  vec2 at = vec2(0.5, -0.5) * view_position + 0.5;
  if (at.x < images_from) return below;
  vec4 over = texture(images, at);
  return over.rgb + (1.0 - over.a) * below;
}
#endif

ivec3 nearest_voxel(vec3 p) {
  return clamp(ivec3(floor(p + 0.5)), ivec3(0), volume_size - 1);
}

#if defined(SPEED) || defined(DATA_SPEED)
vec3 speed_colour(vec3 p, float phi, vec3 grey) {
#ifdef DATA_SPEED
  float speed = data_speed_between(p);
#else
  // The other terms are defined only near the surface; the line where they change their sign needs a pixel's neighbours.
  float near = float(abs(phi) < 0.98 * band);
  bool wanted = near + abs(dFdx(near)) + abs(dFdy(near)) > 0.0;
  float speed = speed_and_curvature_between(term, p, wanted).x;
#endif
  float across = length(vec2(dFdx(speed), dFdy(speed)));
  vec3 colour = diverging(speed);
  // Hatching where it shrinks, so that the sign needs no colour.
  if (speed < 0.0 && mod(gl_FragCoord.x + gl_FragCoord.y, 8.0) < 1.5) colour *= 0.75;
  if (abs(speed) < 0.7 * across) colour = vec3(0.1);
#ifdef SPEED
  if (near == 0.0) colour = 0.5 * grey;
#endif
  return colour;
}
#endif

#ifdef PAGES
vec3 page_picture(vec3 p, vec3 grey) {
  int state = page_state(nearest_voxel(p) / kPageShape);
  vec3 colour = mix(grey, page_colour(state), state >= 2 ? 0.45 : 0.2);
  vec3 in_page = (p + 0.5) / vec3(kPageShape);
  vec3 edge = abs(in_page - floor(in_page + 0.5));
  // Along the slice's own axis there is no edge to be seen.
  vec3 width = fwidth(in_page);
  bvec3 seen = greaterThan(width, vec3(1e-6));
  if (state >= 2 && any(lessThan(mix(vec3(1.0), edge, vec3(seen)), 0.6 * width))) colour = mix(colour, vec3(1.0), 0.5);
  return colour;
}
#endif

#ifdef DOUBT
// Sure parts show the dimmed source. So does all of a function without a doubt.
vec3 doubt_picture(vec3 p, vec3 grey) {
  float doubt = 0.0;
#ifdef SPEED_VOLUME
  doubt = clamp(evaluated_between(p), 0.0, 1.0);
#endif
  return mix(0.5 * grey, doubt_colour(doubt), 0.8 * smoothstep(0.0, 0.5, doubt));
}
#endif

#ifdef CHANGE
// What was won is tinted in the colour of growth, what was lost in that of shrinking, and hatched; a dark line is where the
// surface began. `shift`: positive outside of the start.
vec3 with_change(vec3 colour, float shift, float phi) {
  bool changed = (shift > 0.0) == (phi > 0.0);
  vec3 tint = diverging(shift);
  if (shift < 0.0 && mod(gl_FragCoord.x + gl_FragCoord.y, 8.0) < 1.5) tint *= 0.75;
  if (changed) colour = mix(colour, tint, 0.65);
  float slope = length(vec2(dFdx(shift), dFdy(shift)));
  float line = 1.0 - smoothstep(0.3, 1.0, abs(shift) / max(slope, 1e-6));
  return abs(shift) < 0.99 ? mix(colour, vec3(0.0), 0.8 * line) : colour;
}
#endif

void main() {
  vec4 at = voxel_from_view * vec4(view_position, 0.0, 1.0);
  vec3 p = at.xyz / at.w;
  bool outside = any(lessThan(p, vec3(-0.5))) || any(greaterThan(p, vec3(volume_size) - 0.5));
  float value = source_between(nearest ? vec3(nearest_voxel(p)) : p);
  vec3 grey = vec3(clamp((value - window.x) / window.y + 0.5, 0.0, 1.0));
  float phi = phi_between(p);
  // Derivatives are defined only where all pixels of a block go.
  float phi_slope_in_view = length(vec2(dFdx(phi), dFdy(phi)));
  float pixel = length(dFdx(p) * spacing) / min(spacing.x, min(spacing.y, spacing.z));

#if defined(SPEED) || defined(DATA_SPEED)
  vec3 colour = speed_colour(p, phi, grey);
#elif defined(DOUBT)
  vec3 colour = doubt_picture(p, grey);
#elif defined(PAGES)
  vec3 colour = page_picture(p, grey);
#else
  vec3 colour = grey;
#endif
  vec3 beside = background;
#ifdef IMAGES
  colour = with_images(colour);
  beside = with_images(beside);
#endif
  if (label_opacity > 0.0) {
    int label = int(texelFetch(labels, texel_in_blocks(label_table, nearest_voxel(p)), 0).r);
    vec4 label_colour = texture(label_colours, vec2((float(label) + 0.5) / 256.0, 0.5));
    if (label > 0) colour = mix(colour, label_colour.rgb, label_opacity * label_colour.a);
  }
#ifdef CHANGE
  colour = with_change(colour, evaluated_between(p), phi);
#endif
#ifdef CONSTRAINED
  colour = with_constraint(colour, nearest_voxel(p));
#endif
  if ((show_surface || show_contours) && abs(phi) < band) {
    // Where the slice grazes the surface phi hardly changes in it; a line must not become a patch.
    float per_pixel = max(phi_slope_in_view, 0.4 * pixel);
    // Nor where phi is the same over a whole area, half-way between two slices of a mask.
    float steep = smoothstep(0.1, 0.4, phi_slope_in_view / pixel);
    if (show_contours) {
      float to_contour = abs(phi) < 1.5 ? abs(abs(phi) - 1.0) : abs(abs(phi) - 2.0);
      float line = steep * (1.0 - smoothstep(0.0, 1.0, to_contour / per_pixel));
      colour = mix(colour, phi < 0.0 ? kContourOutside : kContourInside, line);
    }
    if (show_surface) {
      float pixels = abs(phi) / per_pixel;
      float line = steep * (1.0 - smoothstep(0.5 * line_pixels - 0.5, 0.5 * line_pixels + 0.5, pixels));
      colour = mix(colour, kOutlineYellow, line);
    }
  }
  fragment = vec4(outside ? beside : colour, 1.0);
}
