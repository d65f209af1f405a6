// A finished picture: what was laid one under the other, over the background.

uniform sampler2D layers;  // premultiplied
uniform vec3 background;

out vec4 fragment;

void main() {
  vec4 layer = texelFetch(layers, ivec2(gl_FragCoord.xy), 0);
  fragment = vec4(layer.rgb + (1.0 - layer.a) * background, 1.0);
}
