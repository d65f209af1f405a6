// The source on the plane of a slice picture, a texel a pixel, where the volume is too large to be a texture.

uniform sampler2D source_plane;

// On the picture's plane only: `position` is the fragment's.
float source_between(vec3 position) {
  return texelFetch(source_plane, ivec2(gl_FragCoord.xy), 0).r;
}
