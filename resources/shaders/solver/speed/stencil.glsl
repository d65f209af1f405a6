// The 19 values of phi around a voxel, and the differences that every speed term is made of. Lengths are in units
// of the smallest spacing.

#if __VERSION__ < 400
#define precise  // unknown to OpenGL 3.3
#endif

struct Stencil {
  float c;                              // phi at the voxel
  float xm, xp, ym, yp, zm, zp;         // its face neighbours (xm: x - 1, xp: x + 1)
  float xmym, xmyp, xpym, xpyp;         // its edge neighbours
  float xmzm, xmzp, xpzm, xpzp;
  float ymzm, ymzp, ypzm, ypzp;
};

struct Differences {
  float phi;
  vec3 two_central;        // twice the central first differences
  vec3 second;             // pure second differences
  vec3 four_mixed;         // four times d2/dxdy, d2/dxdz, d2/dydz
  float upwind_growing;    // |grad phi| for a speed F > 0 (Osher and Sethian)
  float upwind_shrinking;  // |grad phi| for a speed F < 0
  float lowest_product;    // least product of phi with a face neighbour: < 0 beside the surface
};

uniform vec3 inverse_spacing;

Differences differences(Stencil s) {
  Differences d;
  d.phi = s.c;
  vec3 minus = s.c - vec3(s.xm, s.ym, s.zm);
  vec3 plus = vec3(s.xp, s.yp, s.zp) - s.c;
  d.second = plus - minus;
  d.two_central = plus + minus;
  d.four_mixed = (vec3(s.xpyp, s.xpzp, s.ypzp) - vec3(s.xpym, s.xpzm, s.ypzm)) -
                 (vec3(s.xmyp, s.xmzp, s.ymzp) - vec3(s.xmym, s.xmzm, s.ymzm));
#ifdef ANISOTROPIC
  minus *= inverse_spacing;
  plus *= inverse_spacing;
  d.two_central *= inverse_spacing;
  d.second *= inverse_spacing * inverse_spacing;
  d.four_mixed *= inverse_spacing.xxy * inverse_spacing.yzz;
#endif
  vec3 rise_ahead = max(plus, 0.0);
  vec3 fall_behind = min(minus, 0.0);
  vec3 fall_ahead = min(plus, 0.0);
  vec3 rise_behind = max(minus, 0.0);
  // Not to be fused: fields that are mirrored give mirrored results to the last bit.
  precise vec3 growing = rise_ahead * rise_ahead + fall_behind * fall_behind;
  precise vec3 shrinking = fall_ahead * fall_ahead + rise_behind * rise_behind;
  d.upwind_growing = sqrt(growing.x + growing.y + growing.z);
  d.upwind_shrinking = sqrt(shrinking.x + shrinking.y + shrinking.z);
  vec3 products = min(vec3(s.xm, s.ym, s.zm) * s.c, vec3(s.xp, s.yp, s.zp) * s.c);
  d.lowest_product = min(min(products.x, products.y), products.z);
  return d;
}
