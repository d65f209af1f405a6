// Brings texels from G's one texture to the other, for pages that fall asleep.

uniform sampler2D phi_now;

flat in ivec2 to_phi;

layout(location = 0) out float phi_other;

void main() { phi_other = texelFetch(phi_now, ivec2(gl_FragCoord.xy) + to_phi, 0).r; }
