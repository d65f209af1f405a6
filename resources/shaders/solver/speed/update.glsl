// One explicit step of dphi/dt (paper eq. 5 to 7): the sum of the speed terms.

#include "solver/speed/stencil.glsl"
#include "solver/speed/curvature.glsl"
#include "solver/speed/rescaling.glsl"

uniform float time_step;
uniform float band;
uniform float data_weight;
uniform float curvature_weight;
uniform float rescaling_weight;

// The terms with their weights.
struct Speeds {
  float data;
  float curvature;  // times |grad phi|, except with PAPER_SCHEME
  float rescaling;
  float advection;  // with ADVECTION
};

// `data` is D.
Speeds speeds(Differences d, float data) {
  Speeds s;
  s.data = data_weight * data;
#ifdef PAPER_SCHEME
  s.curvature = curvature_weight * curvature(d);
#else
  float four_squared_gradient;
  s.curvature = curvature_weight * curvature_motion(d, four_squared_gradient);
#endif
  s.rescaling = rescaling_weight * rescaling_speed(d);
  s.advection = 0.0;
  return s;
}

// The new phi of a voxel. With PAPER_SCHEME, eq. 6 literally: one upwind gradient for the total speed.
float upwind_update(float phi, Speeds s, float upwind_growing, float upwind_shrinking) {
#ifdef PAPER_SCHEME
  float speed = s.data + s.curvature;
  float change = speed * (speed > 0.0 ? upwind_growing : upwind_shrinking);
#else
  float change = s.data * (s.data > 0.0 ? upwind_growing : upwind_shrinking) + s.curvature;
#endif
  change += s.rescaling;
#ifdef ADVECTION
  change += s.advection;
#endif
  return clamp(phi + time_step * change, -band, band);
}

float updated_phi(Differences d, Speeds s) {
  return upwind_update(d.phi, s, d.upwind_growing, d.upwind_shrinking);
}
