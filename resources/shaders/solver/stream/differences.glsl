#include "solver/speed/update.glsl"

// The four 4-tuple buffers that the derivatives are handed on in (paper section 4.3, step A).

struct PackedDifferences {
  vec4 upwind;   // phi, upwind_growing, upwind_shrinking, lowest_product
  vec4 central;  // two_central; phi one step earlier
  vec4 second;
  vec4 mixed;    // four_mixed
};

PackedDifferences pack(Differences d, float phi_before) {
  return PackedDifferences(vec4(d.phi, d.upwind_growing, d.upwind_shrinking, d.lowest_product),
                           vec4(d.two_central, phi_before), vec4(d.second, 0.0), vec4(d.four_mixed, 0.0));
}

Differences unpack(PackedDifferences p) {
  return Differences(p.upwind.x, p.central.xyz, p.second.xyz, p.mixed.xyz, p.upwind.y, p.upwind.z, p.upwind.w);
}
