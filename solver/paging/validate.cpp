#include "solver/paging/validate.h"

#include <cmath>

#include "core/index_walk.h"

namespace tidemark::solver {
namespace {

// The voxel just across a face of the voxel, or the voxel itself at the volume's border.
Index3 across(const Geometry& geometry, Index3 voxel, int axis, int side) {
  Index3 other = voxel;
  other[axis] += side;
  return geometry.contains(other) ? other : voxel;
}

Status validate_values(const Field& phi, Index3 first, Index3 valid) {
  Status valid_values;
  all_indices(first, first + valid, [&](Index3 v) {
    const double value = phi.at(v);
    if (std::isfinite(value) && std::abs(value) <= phi.band) return true;
    valid_values = fail(ErrorKind::internal, "phi is {} at voxel ({}, {}, {}), the band is {}", value, v.x,
                        v.y, v.z, phi.band);
    return false;
  });
  return valid_values;
}

// One face of a page, against the constant across it when that page is not resident.
Status validate_face(const Field& phi, Index3 first, Index3 valid, int axis, int side) {
  const int u = (axis + 1) % 3;
  const int w = (axis + 2) % 3;
  for (std::int64_t a = 0; a < valid[u]; ++a) {
    for (std::int64_t b = 0; b < valid[w]; ++b) {
      Index3 voxel = first;
      voxel[u] += a;
      voxel[w] += b;
      if (side > 0) voxel[axis] += valid[axis] - 1;
      const Index3 other = across(phi.geometry, voxel, axis, side);
      const std::int64_t page = phi.layout.translate(other).page;
      if (phi.pages.is_stored(page)) return {};
      if (phi.at(other) != phi.at(voxel)) {
        return fail(ErrorKind::internal,
                    "phi is {} at voxel ({}, {}, {}), beside a page that is not resident", phi.at(voxel),
                    voxel.x, voxel.y, voxel.z);
      }
    }
  }
  return {};
}

}  // namespace

Status validate(const Field& phi) {
  for (std::int64_t page = 0; page < phi.layout.page_count(); ++page) {
    const Index3 first = phi.layout.first_voxel(page);
    const Index3 valid = phi.layout.valid_shape(page);
    if (phi.pages.is_stored(page)) {
      TIDEMARK_TRY(validate_values(phi, first, valid));
    }
    for (int axis = 0; axis < 3; ++axis) {
      for (const int side : {-1, 1}) {
        TIDEMARK_TRY(validate_face(phi, first, valid, axis, side));
      }
    }
  }
  return {};
}

}  // namespace tidemark::solver
