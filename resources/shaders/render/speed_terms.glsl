// The terms of the speed at a voxel near the surface, as the solver computes them; needs solver/phi.glsl and
// render/source.glsl. With SPEED_VOLUME D is what the processor evaluated, else the tent on the source.

#include "solver/speed/stencil.glsl"
#ifdef SPEED_VOLUME
#include "render/evaluated_map.glsl"
#else
#include "solver/speed/data.glsl"
#endif
#include "solver/speed/curvature.glsl"
#include "solver/speed/rescaling.glsl"

uniform float data_weight;
uniform float curvature_weight;
uniform float rescaling_weight;

// As enum class SpeedTerm.
const int kTotalSpeed = 0;
const int kDataSpeed = 1;
const int kCurvatureSpeed = 2;
const int kRescalingSpeed = 3;

Differences differences_at(ivec3 v) {
  const ivec2 u = ivec2(1, 0);
  Stencil s;
  s.c = phi_at(v);
  s.xm = phi_at(v - u.xyy);
  s.xp = phi_at(v + u.xyy);
  s.ym = phi_at(v - u.yxy);
  s.yp = phi_at(v + u.yxy);
  s.zm = phi_at(v - u.yyx);
  s.zp = phi_at(v + u.yyx);
  s.xmym = phi_at(v - u.xxy);
  s.xpyp = phi_at(v + u.xxy);
  s.xmyp = phi_at(v + ivec3(-1, 1, 0));
  s.xpym = phi_at(v + ivec3(1, -1, 0));
  s.xmzm = phi_at(v - u.xyx);
  s.xpzp = phi_at(v + u.xyx);
  s.xmzp = phi_at(v + ivec3(-1, 0, 1));
  s.xpzm = phi_at(v + ivec3(1, 0, -1));
  s.ymzm = phi_at(v - u.yxx);
  s.ypzp = phi_at(v + u.yxx);
  s.ymzp = phi_at(v + ivec3(0, -1, 1));
  s.ypzm = phi_at(v + ivec3(0, 1, -1));
  return differences(s);
}

#ifdef SPEED_VOLUME
float data_speed_between(vec3 position) { return evaluated_between(position); }
float data_speed_of(ivec3 voxel) { return speed_at(min(voxel, volume_size - 1)); }
#else
float data_speed_between(vec3 position) { return data_speed(source_between(position)); }
float data_speed_of(ivec3 voxel) { return data_speed(source_between(vec3(voxel))); }
#endif

// A weighted term, in units of the data term's: 1 is a front that moves at full speed outward.
float speed_of(int term, Differences d, float data_speed) {
  float data = data_weight * data_speed;
  float bending = curvature_weight * curvature(d);
  float rescaling = rescaling_weight * rescaling_speed(d);
  return term == kDataSpeed ? data : term == kCurvatureSpeed ? bending : term == kRescalingSpeed ? rescaling
         : data + bending + rescaling;
}

// Between voxels: the term, and kappa (the sum of the principal curvatures, per smallest spacing). What is not `wanted` is
// not right, and costs an eighth: it is a loop that ends, as nothing else saves work on a driver that computes both sides
// of every branch.
vec2 speed_and_curvature_between(int term, vec3 position, bool wanted) {
  vec3 p = clamp(position, vec3(0.0), vec3(volume_size - 1));
  ivec3 low = min(ivec3(p), max(volume_size - 2, ivec3(0)));
  vec3 f = p - vec3(low);
  vec2 sum = vec2(0.0);
  int corners = wanted ? 8 : 0;
  for (int i = 0; i < corners; ++i) {
    ivec3 corner = ivec3(i & 1, i >> 1 & 1, i >> 2);
    vec3 share = mix(1.0 - f, f, vec3(corner));
    Differences d = differences_at(low + corner);
    sum += share.x * share.y * share.z * vec2(speed_of(term, d, data_speed_of(low + corner)), curvature(d));
  }
  return sum;
}
