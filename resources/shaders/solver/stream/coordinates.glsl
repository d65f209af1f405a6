// Texels are read by texture coordinates, as on the paper's cards, not by number: a software driver
// then has no level of detail to work out for each of them.

uniform vec2 phi_texel;    // the size of a texel of G in texture coordinates
uniform vec2 place_texel;  // ... of the intermediate buffers
