// Uses as many samplers as any program does; draws nothing (see gpu/sampler_slots.h).

uniform sampler2D any[13];

out vec4 fragment;

void main() {
  const ivec2 p = ivec2(0);
  fragment = texelFetch(any[0], p, 0) + texelFetch(any[1], p, 0) + texelFetch(any[2], p, 0) + texelFetch(any[3], p, 0) +
             texelFetch(any[4], p, 0) + texelFetch(any[5], p, 0) + texelFetch(any[6], p, 0) + texelFetch(any[7], p, 0) +
             texelFetch(any[8], p, 0) + texelFetch(any[9], p, 0) + texelFetch(any[10], p, 0) + texelFetch(any[11], p, 0) +
             texelFetch(any[12], p, 0);
}
