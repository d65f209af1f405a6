// Colours with a meaning.

const vec3 kOutlineYellow = vec3(1.0, 0.85, 0.0);
// Of contours of phi outside and inside.
const vec3 kContourOutside = vec3(0.45, 0.75, 1.0), kContourInside = vec3(1.0, 0.60, 0.30);

// Blue below 0 and orange above, told apart by colour-blind people, too.
vec3 diverging(float x) {
  const vec3 cold = vec3(0.13, 0.36, 0.67), warm = vec3(0.80, 0.40, 0.05), middle = vec3(0.95);
  return x < 0.0 ? mix(middle, cold, min(-x, 1.0)) : mix(middle, warm, min(x, 1.0));
}

// Doubt from 0 to 1: the darker the surer, in a hue that means nothing else.
vec3 doubt_colour(float doubt) { return mix(vec3(0.30, 0.05, 0.42), vec3(1.0, 0.80, 0.95), doubt); }

// As enum class PageState: not resident (outside, inside), resident, resident and quiet, just made resident.
vec3 page_colour(int state) {
  return state == 4 ? vec3(0.85, 0.35, 0.60) : state == 3 ? vec3(0.10, 0.62, 0.47) : state == 2 ? vec3(0.20, 0.55, 0.85) :
         state == 1 ? vec3(0.90, 0.75, 0.30) : vec3(0.35);
}
