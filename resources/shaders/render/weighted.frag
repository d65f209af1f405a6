// A picture, each value times a weight: summed up by blending, or divided into a mean.

uniform sampler2D picture;
uniform float weight;

out vec4 fragment;

void main() {
  fragment = weight * texelFetch(picture, ivec2(gl_FragCoord.xy), 0);
}
