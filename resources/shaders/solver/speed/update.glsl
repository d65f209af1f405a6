// One explicit step of dphi/dt (paper eq. 5 to 7): the sum of the speed terms.

#include "solver/speed/stencil.glsl"
#include "solver/speed/data.glsl"
#include "solver/speed/curvature.glsl"
#include "solver/speed/rescaling.glsl"

uniform float time_step;
uniform float band;
uniform float data_weight;
uniform float curvature_weight;
uniform float rescaling_weight;

// The new phi of a voxel. With PAPER_SCHEME, eq. 6 literally: one upwind gradient for the total speed.
float updated_phi(Differences d, float source) {
  float data = data_weight * data_speed(source);
#ifdef PAPER_SCHEME
  float speed = data + curvature_weight * curvature(d);
  float change = speed * (speed > 0.0 ? d.upwind_growing : d.upwind_shrinking);
#else
  float four_squared_gradient;
  float change = data * (data > 0.0 ? d.upwind_growing : d.upwind_shrinking) +
                 curvature_weight * curvature_motion(d, four_squared_gradient);
#endif
  change += rescaling_weight * rescaling_speed(d);
  return clamp(d.phi + time_step * change, -band, band);
}
