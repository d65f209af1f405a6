// Transfer functions evaluated on the fly: the source's opacity and colour are sums of Gaussians and ramps of its value.

const int kMostPrimitives = 16;
uniform int primitive_count;
uniform vec4 primitive_shape[kMostPrimitives];   // 0 Gaussian, 1 ramp; centre or start; width or end; opacity a mm
uniform vec3 primitive_colour[kMostPrimitives];

float opacity_of(int i, float value) {
  vec4 shape = primitive_shape[i];
  if (shape.x < 0.5) {
    float x = (value - shape.y) / shape.z;
    return shape.w * exp(-x * x);
  }
  return shape.w * clamp((value - shape.y) / (shape.z - shape.y), 0.0, 1.0);
}

// Colour, and opacity of a millimetre.
vec4 classify(float value) {
  vec3 colour = vec3(0.0);
  float opacity = 0.0;
  for (int i = 0; i < primitive_count; ++i) {
    float share = opacity_of(i, value);
    colour += share * primitive_colour[i];
    opacity += share;
  }
  return opacity > 0.0 ? vec4(colour / opacity, opacity) : vec4(0.0);
}

// The greatest opacity of any value in [low, high].
float most_opacity(float low, float high) {
  float opacity = 0.0;
  for (int i = 0; i < primitive_count; ++i) {
    float start = primitive_shape[i].y;
    float nearest = primitive_shape[i].x < 0.5 ? clamp(start, low, high) : primitive_shape[i].z > start ? high : low;
    opacity += opacity_of(i, nearest);
  }
  return opacity;
}
