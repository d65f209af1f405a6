// Texels are read by texture coordinates, as on the paper's cards, not by number: a software driver
// then has no level of detail to work out for each of them.

// G's layers follow each other along y: layer n has the coordinates n to n + 1.

uniform vec2 phi_texel;    // the size of a texel of G in texture coordinates
uniform vec2 place_texel;  // ... of the intermediate buffers

// A texel of G.
float texel_of(sampler2DArray memory, vec2 position) {
  float layer = floor(position.y);
  return textureLod(memory, vec3(position.x, position.y - layer, layer), 0.0).r;
}
