// One value for every texel that is drawn, in up to two textures.

uniform vec4 value;

layout(location = 0) out vec4 colour_0;
layout(location = 1) out vec4 colour_1;

void main() { colour_0 = colour_1 = value; }
