// The rescaling term G_r (paper eq. 5): phi (g_phi - |grad phi|), which keeps phi a clamped distance transform. The
// gradient is taken from the side of the surface, and goes over into the mean of both sides beside the surface.

uniform float target_gradient;

// The product of phi with a neighbour of the other sign at which that neighbour counts in full.
const float kFullSignChange = 0.1;

float rescaling_speed(Differences d) {
  bool is_inside = d.phi > 0.0;
  float toward = is_inside ? d.upwind_shrinking : d.upwind_growing;
  float away = is_inside ? d.upwind_growing : d.upwind_shrinking;
  float share = clamp(d.lowest_product * (-0.5 / kFullSignChange), 0.0, 0.5);
  return d.phi * (target_gradient - (toward + share * (away - toward)));
}
