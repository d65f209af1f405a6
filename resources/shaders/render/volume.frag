// The volume rendering by rays, each from page to page. The surface is found to a fraction of a voxel in phi's
// resident pages; pages in which neither surface nor source shows anything are crossed in one stride.
//
// Variants: SURFACE and SOURCE show them; REGION where phi says which part of the source shows; CLIP with a clip
// plane; LABELS shows their borders; SPEED_COLOURS where a term of the speed colours the surface; OCCLUSION darkens its
// hollows; PICK says where a ray first meets something instead of a colour; FAST_GRADIENT lights the source less well;
// NO_SKIP computes what is empty, too.
//
// What a ray does is arranged in loops that end at an event: a processor that plays the GPU computes both sides of every
// branch, so that what is done once for a surface must not stand where each step would pay for it.

#include "solver/phi.glsl"
#include "solver/volume_blocks.glsl"
#include "render/source.glsl"
#include "render/shade.glsl"
#include "render/page_state.glsl"
#include "render/ray.glsl"
#ifdef SPEED_COLOURS
#include "render/speed_terms.glsl"
#endif
#include "render/events.glsl"

in vec2 view_position;
out vec4 fragment;

uniform mat4 voxel_from_view;         // from the view's cube to voxel coordinates
uniform samplerBuffer page_opacity;   // the most of any voxel in each page of V_P: all outside, all inside, mixed
uniform float step_voxels;
uniform int jitter_round;             // another offset of the samples in each round
uniform vec3 background;

#if defined(SURFACE) || defined(REGION)
#define NEEDS_PHI
#endif

const int kMostJoined = 8;            // pages
const int kMostLayers = 64;           // of surface and clip plane along a ray

float t = 0.0;
bool inside = false;                  // of the surface, at t

// Offsets without a pattern that the eye finds (interleaved gradient noise, Jimenez 2014).
float jitter() {
  vec2 p = gl_FragCoord.xy + 5.588238 * float(jitter_round);
  return max(fract(52.9829189 * fract(dot(p, vec2(0.06711056, 0.00583715)))), 0.05);
}

// Where phi is 0 between two places of other signs, by false position (the Illinois variant).
float crossing(float a, float b, float phi_a, float phi_b) {
  float at = a;
  for (int i = 0; i < 3; ++i) {
    at = (a * phi_b - b * phi_a) / (phi_b - phi_a);
    float phi = phi_between(on_ray(at));
    bool like_b = (phi > 0.0) == (phi_b > 0.0);
    a = like_b ? a : at;
    b = like_b ? at : b;
    phi_a = like_b ? 0.5 * phi_a : phi;
    phi_b = like_b ? phi : 0.5 * phi_b;
  }
  return at;
}

// The next piece of the ray in which the surface is, from t: its ends and phi there.
struct Piece {
  bool found;
  float a, b;
  float phi_a, phi_b;
};

#if !defined(SOURCE) && !defined(SURFACE)
Piece march(float stop) {
  t = max(t, stop);
  return Piece(false, t, t, 0.0, 0.0);
}
#elif !defined(SOURCE)
// Until `stop`, with the surface alone. Where phi is +-W the surface is some voxels away; elsewhere phi says how far, but
// may be twice as steep as a distance.
Piece march(float stop) {
  Piece piece = Piece(false, t, t, 0.0, 0.0);
  float voxels_per_phi = min(spacing.x, min(spacing.y, spacing.z)) / ray_mm;
  float nearly_band = 0.98 * band;
  float before = t;
  while (t < stop && !piece.found) {
    while (t < stop) {
      enter_page(t);
      bool resident = physical >= kFirstPage;
#ifdef NO_SKIP
      break;
#endif
      if (resident && abs(nearest_phi(t)) < nearly_band) break;
      before = t;
      t = resident ? min(t + 1.0, page_end) : page_end;
    }
    // Step by step, while phi varies.
    float phi_a = phi_between(on_ray(t));
    bool passed = t < stop && (phi_a > 0.0) != inside;  // in the last stride
    piece = Piece(passed, before, t, inside ? 1.0 : -1.0, phi_a);
    while (t < stop && !piece.found) {
      float next = t + step_voxels;
#ifndef NO_SKIP
      next = max(next, t + 0.5 * abs(phi_a) * voxels_per_phi);
#endif
      next = min(next, stop);
      float phi_b = phi_between(on_ray(next));
      if ((phi_b > 0.0) != inside) piece = Piece(true, t, next, phi_a, phi_b);
      before = t;
      t = next;
      phi_a = phi_b;
#ifndef NO_SKIP
      if (abs(phi_b) > nearly_band) break;
#endif
    }
  }
  return piece;
}
#else
// In the page entered, from t, adding the source on the way; `resident` is a constant, so that phi is looked up only
// where it varies.
void march_in_page(const bool resident, float stride, inout Piece piece) {
  float static_phi = physical == kInsidePage ? band : -band;
  float value_a = source_between(on_ray(t));
  float phi_a = static_phi;
  if (resident) phi_a = phi_between(on_ray(t));
  float phi_b = phi_a;
  while (t < page_end && !piece.found && result.a < 0.99) {
    // To the next piece that shows anything.
    vec4 material = vec4(0.0);
    float a = t;
    float length_mm = 0.0;
    vec3 gradient = vec3(0.0);
    float middle = 0.0;
#ifndef BY_GRADIENT  // which is most of a step: what shows adds little to it
    while (t < page_end && !piece.found && material.a * length_mm <= kLeastOpacity)
#endif
    {
      a = t;
      float next = min(t + stride, page_end);
      stride = step_voxels;
      float value_b = source_between(on_ray(next));
      if (resident) {
        phi_b = phi_between(on_ray(next));
#ifdef SURFACE
        if ((phi_b > 0.0) != inside) {
          piece = Piece(true, t, next, phi_a, phi_b);
          // Up to the surface; what is behind it comes after it.
          float share = clamp(phi_a / (phi_a - phi_b), 0.0, 1.0);
          next = mix(t, next, share);
          value_b = mix(value_a, value_b, share);
          phi_b = phi_a;
        }
#endif
      }
      length_mm = max(min(next, for_source.y) - max(t, for_source.x), 0.0) * ray_mm;
#ifdef REGION
      length_mm *= share_in_region(phi_a, phi_b);
#endif
      middle = 0.5 * (value_a + value_b);
#ifdef BY_GRADIENT
      gradient = source_gradient(on_ray(0.5 * (t + next)), spacing, middle);
#endif
      material = classify(value_a, value_b, length(gradient), 0.5 * (phi_a + phi_b));
      value_a = value_b;
      phi_a = phi_b;
      t = next;
    }
#ifndef BY_GRADIENT
    gradient = source_gradient(on_ray(0.5 * (a + t)), spacing, middle);
#endif
    if (material.a * length_mm > kLeastOpacity) {
      add_source(material, gradient, viewer, phi_b, length_mm);
      pick(kPickedSource, on_ray(a));
    }
  }
}

bool phi_varies() {
#ifdef NEEDS_PHI
  return physical >= kFirstPage;
#else
  return false;
#endif
}

// Whether anything shows in the page entered.
bool page_shows() {
#ifdef NO_SKIP
  return true;
#endif
  bool resident = physical >= kFirstPage;
  vec3 opacity = texelFetch(page_opacity, page_number(page)).rgb;
  float most = resident ? opacity.z : physical == kInsidePage ? opacity.y : opacity.x;
#ifdef SURFACE
  if (resident) most = 1.0;
#endif
  return most > kLeastOpacity;
}

// Takes the pages behind the one entered for a part of it, while they show and phi is the same. Rays side by side leave a
// page after different numbers of steps, and those that are through wait for the others.
void join_pages(float stop) {
  int entered = physical;
  float joined = page_end;
  bool like = true;
  for (int i = 0; i < kMostJoined && like && joined < stop; ++i) {
    enter_page(joined);
    like = page_shows() && !phi_varies() && (physical == kInsidePage) == (entered == kInsidePage);
    if (like) joined = page_end;
  }
  physical = entered;
  page_end = joined;
}

// Until `stop`, adding the source on the way.
Piece march(float stop) {
  Piece piece = Piece(false, t, t, 0.0, 0.0);
  float stride = jitter() * step_voxels;
  while (t < stop && !piece.found && result.a < 0.99) {
    // Pages without the surface, most of which show nothing.
    bool varies = false;
    while (t < stop && !varies && result.a < 0.99) {
      bool shows = false;
      while (t < stop && !shows) {
        enter_page(t);
        shows = page_shows();
        if (!shows) t = page_end;
      }
      varies = shows && phi_varies();
      if (shows && !varies) join_pages(stop);
      page_end = varies ? t : min(page_end, stop);
      march_in_page(false, stride, piece);
    }
#ifdef NEEDS_PHI
    // Pages with it.
    while (t < stop && varies && !piece.found && result.a < 0.99) {
      enter_page(t);
      page_end = min(page_end, stop);
      varies = phi_varies() && page_shows();
      if (!varies) page_end = t;
      march_in_page(true, stride, piece);
    }
#endif
  }
  return piece;
}
#endif

#ifdef LABELS
uniform isamplerBuffer page_labels;   // of each page of V_P: 0 where none shows, the label that it has throughout, or -1

float label_t = 0.0;                  // how far labels have been looked at
int label_there = 0;
float label_border = kNever;          // where the next one begins or ends
int label_met = 0;                    // and which
bool label_on_face = false;           // of the volume

// Finds the next border from label_t on, until `stop`.
void find_label(float stop) {
  int next = label_there;
  float before = label_t;
  while (label_t < stop && next == label_there) {
    // Pages that have this label throughout.
    bool varies = false;
    while (label_t < stop && !varies) {
      enter_page(label_t);
      varies = texelFetch(page_labels, page_number(page)).r != label_there;
#ifdef NO_SKIP
      varies = true;
#endif
      if (!varies) label_t = page_end;
    }
    // Step by step in the others.
    float leave = min(page_end, stop);
    while (label_t < leave && next == label_there) {
      before = label_t;
      label_t = min(label_t + step_voxels, leave);
      next = label_between(on_ray(label_t));
    }
  }
  float after = label_t;
  for (int i = 0; i < 5; ++i) {
    float middle = 0.5 * (before + after);
    bool is_next = label_between(on_ray(middle)) != label_there;
    before = is_next ? before : middle;
    after = is_next ? middle : after;
  }
  label_border = next != label_there ? after : kNever;
  label_met = next != 0 ? next : label_there;
  label_there = next;
}
#endif

// Whether anything may be met on the ray from here on.
bool goes_on(float end) {
#ifdef LABELS
  return t <= end || label_border < kNever;
#else
  return t <= end;
#endif
}

void main() {
  vec2 whole = begin_ray(voxel_from_view, view_position, spacing);
  clip_ray(whole);
  // From where anything shows to where nothing does any more.
  float end = -1e9;
  t = 1e9;
#ifdef SURFACE
  t = for_surface.x;
  end = for_surface.y;
#endif
#ifdef SOURCE
  t = min(t, for_source.x);
  end = max(end, for_source.y);
#endif
#ifdef LABELS
  t = min(t, for_surface.x);
  end = max(end, for_surface.y);
  label_t = for_surface.x;
  label_there = for_surface.x <= for_surface.y ? label_between(on_ray(label_t)) : 0;
  // Where it meets the volume's border a label is closed.
  label_on_face = label_there != 0 && label_t <= whole.x + 1e-3;
  label_border = whole.x;
  label_met = label_there;
  if (!label_on_face) find_label(for_surface.y - 2e-3);
#endif
#ifdef CLIP
  if (cut < kNever) {
    t = min(t, cut);
    end = max(end, cut);
  }
#endif
#ifdef NEEDS_PHI
  inside = phi_between(on_ray(t)) > 0.0;
#endif
  bool enters_inside = false;
#ifdef SURFACE
  // Where the inside meets the volume's border the surface is closed.
  enters_inside = inside && t <= whole.x + 1e-3;
#endif
  for (int layer = 0; layer < kMostLayers && goes_on(end) && whole.x < whole.y && result.a < 0.99; ++layer) {
    float stop = cut < kNever ? cut : end;
#ifdef LABELS
    stop = min(stop, label_border);
#endif
    Piece piece = Piece(false, t, t, 0.0, 0.0);
    bool enters = layer == 0 && enters_inside;
    if (!enters) piece = march(stop);
#ifdef SURFACE
    bool leaves = !enters && !piece.found && inside && stop >= whole.y - 1e-3;
    if (piece.found || enters || leaves) {
      float at = enters ? whole.x : leaves ? whole.y : crossing(piece.a, piece.b, piece.phi_a, piece.phi_b);
      vec3 rise = enters || leaves ? face_at(on_ray(at)) * spacing : phi_slope(on_ray(at));
      if (at >= for_surface.x && at <= for_surface.y) add_surface(on_ray(at), rise);
      if (piece.found) inside = !inside;
    }
    piece.found = piece.found || enters;
#endif
#ifdef LABELS
    if (!piece.found && label_border <= stop) {
      vec3 p = on_ray(label_border);
      add_label(label_met, p, label_on_face ? face_at(p) * spacing : label_slope(label_met, p));
      label_on_face = false;
      find_label(for_surface.y - 2e-3);
      piece.found = true;
    }
#endif
#ifdef CLIP
    if (!piece.found && cut < kNever && result.a < 0.99) {
#ifdef SURFACE
      add_clip_picture(on_ray(cut), phi_between(on_ray(cut)), phi_slope(on_ray(cut)));
#else
      add_clip_picture(on_ray(cut), 0.0, vec3(0.0));
#endif
      cut = kNever;
    } else
#endif
    if (!piece.found) break;
  }
#ifdef PICK
  fragment = picked;
#else
  fragment = vec4(result.rgb + (1.0 - result.a) * background, 1.0);
#endif
}
