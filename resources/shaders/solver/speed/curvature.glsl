// The curvature term: kappa = div(grad phi / |grad phi|), the sum of the principal curvatures.

const float kSmallestGradientSquared = 1e-3;
const float kLargestCurvature = 6.0;

// kappa |grad phi| by the direct form tr(H) - (g . H g) / |g|^2, g the central gradient.
float curvature_motion(Differences d, out float four_squared_gradient) {
  vec3 g = d.two_central;
  vec3 squares = g * g;
  float squared = squares.x + squares.y + squares.z;
  float trace = d.second.x + d.second.y + d.second.z;
  float pure = dot(squares, d.second);
  float two_mixed = dot(g.xxy * g.yzz, d.four_mixed);
  four_squared_gradient = max(squared, 4.0 * kSmallestGradientSquared);
  return (squared * trace - (pure + 0.5 * two_mixed)) / four_squared_gradient;
}

// kappa per smallest spacing; < 0 on a ball.
float curvature(Differences d) {
  float four_squared_gradient;
  float motion = curvature_motion(d, four_squared_gradient);
  return clamp(2.0 * motion * inversesqrt(four_squared_gradient), -kLargestCurvature, kLargestCurvature);
}
