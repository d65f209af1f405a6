// Transfer functions, evaluated on the fly (paper section 6.2): sums of primitives, each the product of a factor
// along every axis. The source has (value, gradient magnitude, phi), the surface (intensity, distance from the
// clip plane).
//
// How many primitives there are and of what kinds their factors are is fixed when the shader is compiled, as kinds that
// are not there cost nothing then: SOURCE_PRIMITIVES with VALUE_KINDS, GRADIENT_KINDS, PHI_KINDS, and
// SURFACE_PRIMITIVES with INTENSITY_KINDS, DISTANCE_KINDS, lists of one number for each. Where they are is uniform.

// As enum class TransferFactor::Kind.
const int kAnything = 0;
const int kGaussian = 1;  // x centre, y width
const int kRamp = 2;      // x start, y where it is 1

float factor(const int kind, vec2 shape, float x) {
  if (kind == kAnything) return 1.0;
  if (kind == kRamp) return clamp((x - shape.x) / (shape.y - shape.x), 0.0, 1.0);
  float u = (x - shape.x) / shape.y;
  return exp(-u * u);
}

// Abramowitz and Stegun 7.1.28, to 3e-7.
float error_function(float x) {
  float a = abs(x);
  float d = 1.0 + a * (0.0705230784 + a * (0.0422820123 + a * (0.0092705272 + a * (0.0001520143 + a * (0.0002765672 +
            a * 0.0000430638)))));
  d *= d;
  d *= d;
  d *= d;
  d *= d;
  return sign(x) * (1.0 - 1.0 / d);
}

// The ramp's integral from 0.
float ramp_integral(float x) {
  float c = clamp(x, 0.0, 1.0);
  return 0.5 * c * c + max(x - 1.0, 0.0);
}

// The mean of a factor while x goes evenly from a to b: no step is too long for a thin Gaussian.
float mean_factor(const int kind, vec2 shape, float a, float b) {
  if (kind == kAnything) return 1.0;
  float width = kind == kGaussian ? shape.y : shape.y - shape.x;
  float u = (a - shape.x) / width;
  float v = (b - shape.x) / width;
  float there = factor(kind, shape, 0.5 * (a + b));
  float integral = kind == kGaussian ? 0.88622693 * (error_function(v) - error_function(u))  // sqrt(pi) / 2
                                     : ramp_integral(v) - ramp_integral(u);
  return abs(v - u) < 0.1 ? there : integral / (v - u);
}

#if defined(SOURCE_PRIMITIVES) && SOURCE_PRIMITIVES > 0
const int value_kind[SOURCE_PRIMITIVES] = int[](VALUE_KINDS);
const int gradient_kind[SOURCE_PRIMITIVES] = int[](GRADIENT_KINDS);
const int phi_kind[SOURCE_PRIMITIVES] = int[](PHI_KINDS);
uniform vec2 value_shape[SOURCE_PRIMITIVES];
uniform vec2 gradient_shape[SOURCE_PRIMITIVES];
uniform vec2 phi_shape[SOURCE_PRIMITIVES];
uniform vec4 source_material[SOURCE_PRIMITIVES];  // colour, and opacity of a mm

// Colour, and opacity of a mm, while the value goes from a to b.
vec4 classify(float a, float b, float gradient, float phi) {
  vec3 colour = vec3(0.0);
  float opacity = 0.0;
  for (int i = 0; i < SOURCE_PRIMITIVES; ++i) {
    float share = source_material[i].a * mean_factor(value_kind[i], value_shape[i], a, b) *
                  factor(gradient_kind[i], gradient_shape[i], gradient) * factor(phi_kind[i], phi_shape[i], phi);
    colour += share * source_material[i].rgb;
    opacity += share;
  }
  return opacity > 0.0 ? vec4(colour / opacity, opacity) : vec4(0.0);
}
#endif

#if defined(SURFACE_PRIMITIVES) && SURFACE_PRIMITIVES > 0
const int intensity_kind[SURFACE_PRIMITIVES] = int[](INTENSITY_KINDS);
const int distance_kind[SURFACE_PRIMITIVES] = int[](DISTANCE_KINDS);
uniform vec2 intensity_shape[SURFACE_PRIMITIVES];
uniform vec2 distance_shape[SURFACE_PRIMITIVES];
uniform vec4 surface_material[SURFACE_PRIMITIVES];  // colour and opacity

// Colour and opacity of the surface.
vec4 classify_surface(float intensity, float distance_mm) {
  vec3 colour = vec3(0.0);
  float opacity = 0.0;
  for (int i = 0; i < SURFACE_PRIMITIVES; ++i) {
    float share = surface_material[i].a * factor(intensity_kind[i], intensity_shape[i], intensity) *
                  factor(distance_kind[i], distance_shape[i], distance_mm);
    colour += share * surface_material[i].rgb;
    opacity += share;
  }
  return opacity > 0.0 ? vec4(colour / opacity, min(opacity, 1.0)) : vec4(0.0);
}
#endif
