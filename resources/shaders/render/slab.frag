// What lies between two slices that are next to each other, in as many steps as the step's length asks for (paper section
// 5): interpolated, classified, lit, and laid under what is in front of it. Variants as of volume.frag.

#include "solver/phi.glsl"
#include "solver/volume_blocks.glsl"
#include "render/slices.glsl"
#include "render/shade.glsl"
#include "render/page_state.glsl"
#include "render/ray.glsl"
#ifdef SPEED_COLOURS
#include "render/speed_terms.glsl"
#endif
#include "render/events.glsl"

in vec2 view_position;
out vec4 fragment;  // premultiplied

uniform mat4 voxel_from_view;  // from the view's cube to voxel coordinates
uniform float front_plane;     // the slab's ends: voxel coordinates along the axis
uniform float back_plane;
uniform vec2 low_across;       // and where anything shows in it: along the slices' own axes
uniform vec2 high_across;
uniform int steps;

// A place of the ray with what the slices say of it.
struct Sample {
  float t;
  vec4 phi;     // and d phi / d voxel
  vec4 source;  // and its gradient a voxel
};

Sample sample_at(float t) {
  vec3 p = on_ray(t);
  Sample s = Sample(t, vec4(-band, 0.0, 0.0, 0.0), vec4(0.0));
#if defined(SURFACE) || defined(REGION)
  s.phi = between_slices(phi_front, phi_back, p);
#endif
#ifdef SOURCE
  s.source = between_slices(source_front, source_back, p);
#endif
  return s;
}

#ifdef SOURCE
void add_source_between(Sample a, Sample b) {
  float length_mm = max(min(b.t, for_source.y) - max(a.t, for_source.x), 0.0) * ray_mm;
#ifdef REGION
  length_mm *= share_in_region(a.phi.x, b.phi.x);
#endif
  vec3 gradient = 0.5 * (a.source.yzw + b.source.yzw) / spacing;
  vec4 material = classify(a.source.x, b.source.x, length(gradient), 0.5 * (a.phi.x + b.phi.x));
  add_source(material, gradient, viewer, b.phi.x, length_mm);
}
#endif

void main() {
  vec2 whole = begin_ray(voxel_from_view, view_position, spacing);
  clip_ray(whole);
  vec2 planes = (vec2(front_plane, back_plane) - ray_start.ALONG) / ray_direction.ALONG;
  vec2 to_low = (low_across - ray_start.ACROSS) * ray_inverse.ACROSS;
  vec2 to_high = (high_across - ray_start.ACROSS) * ray_inverse.ACROSS;
  vec2 enter = min(to_low, to_high);
  vec2 leave = max(to_low, to_high);
  float begin = max(max(planes.x, whole.x), max(enter.x, enter.y));
  float end = min(min(planes.y, whole.y), min(leave.x, leave.y));
  float step_length = (planes.y - planes.x) / float(steps);
  bool meets_picture = cut >= begin && cut < end;
  if (meets_picture) end = cut;
  Sample a = sample_at(begin);
#if defined(SURFACE) || defined(LABELS)
  // Where the inside or a label meets the volume's border it is closed, unless the clip plane hides that.
  bool enters = begin < end && begin <= whole.x + 1e-3 && begin >= for_surface.x && begin <= for_surface.y;
#endif
#ifdef SURFACE
  if (enters && a.phi.x > 0.0) {
    add_surface(on_ray(begin), face_at(on_ray(begin)) * spacing);
  }
#endif
#ifdef LABELS
  int label = label_between(on_ray(begin));
  int label_before = label;
  int label_met = 0;
  vec2 label_border = vec2(kNever);  // between these places; the first one of the slab
  if (enters && label != 0) {
    add_label(label, on_ray(begin), face_at(on_ray(begin)) * spacing);
  }
#endif
  while (a.t < end) {
    float next = a.t + step_length;
    Sample b = sample_at(next > end - 0.01 * step_length ? end : next);
#ifdef SURFACE
    bool crosses = (a.phi.x > 0.0) != (b.phi.x > 0.0);
    Sample back = b;
    if (crosses) {
      // Up to the surface; what is behind it comes next.
      float share = a.phi.x / (a.phi.x - b.phi.x);
      b = Sample(mix(a.t, b.t, share), mix(a.phi, b.phi, share), mix(a.source, b.source, share));
      b.phi.x = a.phi.x;
    }
#endif
#ifdef SOURCE
    add_source_between(a, b);
#endif
#ifdef SURFACE
    if (crosses) {
      if (b.t >= for_surface.x && b.t <= for_surface.y) add_surface(on_ray(b.t), b.phi.yzw);
      b.phi.x = back.phi.x;
    }
#endif
#ifdef LABELS
    int label_b = label_between(on_ray(b.t));
    if (label_b != label && label_border.x == kNever) {
      label_border = vec2(a.t, b.t);
      label_before = label;
      label_met = label_b != 0 ? label_b : label;
    }
    label = label_b;
#endif
    a = b;
  }
#ifdef LABELS
  for (int i = 0; i < 5; ++i) {
    float middle = 0.5 * (label_border.x + label_border.y);
    if (label_between(on_ray(middle)) == label_before) label_border.x = middle;
    else label_border.y = middle;
  }
  if (label_border.y >= for_surface.x && label_border.y <= for_surface.y) {
    add_label(label_met, on_ray(label_border.y), label_slope(label_met, on_ray(label_border.y)));
  }
#endif
#ifdef SURFACE
  bool leaves = begin < end && end >= whole.y - 1e-3 && end >= for_surface.x && end <= for_surface.y;
  if (leaves && a.phi.x > 0.0) {
    add_surface(on_ray(end), face_at(on_ray(end)) * spacing);
  }
#endif
#ifdef CLIP
  if (meets_picture) add_clip_picture(on_ray(cut), a.phi.x, a.phi.yzw);
#endif
  fragment = result;
}
