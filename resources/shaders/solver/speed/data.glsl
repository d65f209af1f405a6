// The data term D(I) (paper eq. 7): the surface grows where the source is within epsilon of T.

uniform float target;
uniform float data_peak;
uniform float data_slope;
uniform float data_floor;

float data_speed(float source) {
  return max(data_peak - abs(source - target) * data_slope, data_floor);
}
