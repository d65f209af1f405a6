// The volume rendering: a ray for each pixel, from page to page. The surface is found to a fraction of a voxel in phi's
// resident pages; pages in which neither surface nor source shows anything are crossed in one stride.

#include "solver/phi.glsl"
#include "render/source.glsl"
#include "render/transfer.glsl"

in vec2 view_position;
out vec4 fragment;

uniform mat4 voxel_from_view;       // from the view's cube to voxel coordinates
uniform vec3 spacing;               // mm
uniform samplerBuffer page_range;   // the source's least and greatest value in each page of V_P, and one voxel around
uniform float step_voxels;
uniform float jitter;               // of the ray's first step, 0..1
uniform vec4 surface_colour;        // and opacity
uniform bool show_surface;
uniform bool show_source;
uniform int region;                 // where the source shows: 0 everywhere, 1 inside, 2 outside of the surface
uniform bool clip;
uniform vec4 clip_plane;            // in voxel coordinates: hidden where dot(xyz, p) > w
uniform vec2 window;                // centre and width, of the clip plane's picture
uniform vec3 background;

vec4 result = vec4(0.0);  // premultiplied, front to back
vec3 light = vec3(0.0);   // mm, from the surface to the viewer

void add(vec3 colour, float opacity) {
  result += (1.0 - result.a) * vec4(colour * opacity, opacity);
}

// Blinn-Phong with the light at the viewer.
vec3 lit(vec3 colour, vec3 slope) {
  vec3 normal = slope / spacing;
  float length_of = length(normal);
  if (length_of < 1e-6) return colour;
  float facing = abs(dot(normal / length_of, light));
  return colour * (0.22 + 0.78 * facing) + vec3(0.25) * pow(facing, 40.0);
}

// The picture on the clip plane: the source in its window, the surface's cut in yellow.
void add_cut(vec3 p, float pixel_voxels) {
  if (any(lessThan(p, vec3(-0.5))) || any(greaterThan(p, vec3(volume_size) - 0.5))) return;
  float grey = clamp((source_between(p) - window.x) / window.y + 0.5, 0.0, 1.0);
  float phi = phi_between(p);
  float line = 1.0 - smoothstep(0.6, 1.2, abs(phi) / max(pixel_voxels, 0.05) * 0.8);
  add(mix(vec3(grey), vec3(1.0, 0.85, 0.0), show_surface && abs(phi) < band ? line : 0.0), 1.0);
}

void main() {
  vec4 a = voxel_from_view * vec4(view_position, -1.0, 1.0);
  vec4 b = voxel_from_view * vec4(view_position, 1.0, 1.0);
  vec3 start = a.xyz / a.w;
  vec3 way = b.xyz / b.w - start;
  vec3 direction = way / length(way);  // a unit of t is a voxel
  light = -normalize(direction * spacing);
  float step_mm = length(direction * spacing) * step_voxels;
  float pixel_voxels = length(dFdx(start) + dFdy(start));

  // The part of the ray inside the volume.
  vec3 inverse = 1.0 / (direction + vec3(equal(direction, vec3(0.0))) * 1e-9);
  vec3 to_low = (vec3(-0.5) - start) * inverse;
  vec3 to_high = (vec3(volume_size) - 0.5 - start) * inverse;
  vec3 enter = min(to_low, to_high);
  vec3 leave = max(to_low, to_high);
  float t = max(max(enter.x, max(enter.y, enter.z)), 0.0);
  float end = min(leave.x, min(leave.y, leave.z));

  float cut = -1.0;  // where the ray meets the clip plane from its hidden side
  if (clip) {
    float slope = dot(clip_plane.xyz, direction);
    float distance_of = clip_plane.w - dot(clip_plane.xyz, start);
    if (abs(slope) > 1e-6) {
      float meets = distance_of / slope;
      if (slope < 0.0) {
        if (meets > t && meets < end) cut = meets;
        t = max(t, meets);
      } else {
        end = min(end, meets);
      }
    } else if (distance_of < 0.0) {
      end = t;
    }
  }
  if (t < end) {
    if (cut > 0.0) add_cut(start + cut * direction, pixel_voxels);
    t += jitter * step_voxels;
    float before = phi_between(start + t * direction);
    for (int stride = 0; stride < 4096 && t < end && result.a < 0.99; ++stride) {
      // The page that the ray is in, and where it leaves it.
      vec3 p = start + (t + 1e-3) * direction;
      ivec3 page = clamp(ivec3(p + 0.5) / kPageShape, ivec3(0), page_grid - 1);
      vec3 low = vec3(page * kPageShape) - 0.5;
      vec3 out_of = max((low - start) * inverse, (low + vec3(kPageShape) - start) * inverse);
      float page_end = min(end, max(min(out_of.x, min(out_of.y, out_of.z)), t + 1e-3));
      int physical = physical_page(page);
      vec2 range = texelFetch(page_range, page_number(page)).rg;
      bool source_shows = show_source && most_opacity(range.x, range.y) > 1e-4 &&
                          !(physical < kFirstPage && region != 0 && (physical == kInsidePage) != (region == 1));
      bool surface_shows = physical >= kFirstPage && (show_surface || region != 0);
      if (!source_shows && !surface_shows) {
        t = page_end;
        before = physical < kFirstPage ? (physical == kInsidePage ? band : -band) : phi_between(start + t * direction);
        continue;
      }
      while (t < page_end && result.a < 0.99) {
        float next = t + step_voxels;
        vec3 q = start + next * direction;
        float phi = physical >= kFirstPage || surface_shows ? phi_between(q) : before;
        if (show_surface && (before > 0.0) != (phi > 0.0)) {
          // One step of false position after linear interpolation.
          float at = t + step_voxels * before / (before - phi);
          float there = phi_between(start + at * direction);
          at += (there > 0.0) == (before > 0.0) ? (next - at) * there / (there - phi)
                                                : (t - at) * there / (there - before);
          vec3 hit = start + at * direction;
          add(lit(surface_colour.rgb, phi_slope(hit)), surface_colour.a);
        }
        if (source_shows && (region == 0 || (phi > 0.0) == (region == 1))) {
          vec4 material = classify(source_between(q));
          if (material.a > 1e-4) {
            const vec2 h = vec2(1.0, 0.0);
            vec3 slope = vec3(source_between(q + h.xyy) - source_between(q - h.xyy),
                              source_between(q + h.yxy) - source_between(q - h.yxy),
                              source_between(q + h.yyx) - source_between(q - h.yyx));
            add(lit(material.rgb, slope), 1.0 - exp(-material.a * step_mm));
          }
        }
        before = phi;
        t = next;
      }
    }
  }
  fragment = vec4(result.rgb + (1.0 - result.a) * background, 1.0);
}
