// The crossings of a surface with the lines of the grid, as the points that distances are taken between.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "core/progress.h"
#include "solver/field.h"

namespace tidemark::solver {

// Calls visit(voxel) for the voxels of all pages but those that are outside throughout. Returns false when it
// was stopped.
template <class Visit>
bool for_each_voxel(const Field& phi, const Progress& progress, const Visit& visit) {
  for (std::int64_t page = 0; page < phi.layout.page_count(); ++page) {
    if (phi.pages.kind(page) == Field::Kind::outside) continue;
    if (progress.cancelled()) return false;
    const Index3 first = phi.layout.first_voxel(page);
    const Index3 valid = phi.layout.valid_shape(page);
    for (Index3 local(0); local.z < valid.z; ++local.z) {
      for (local.y = 0; local.y < valid.y; ++local.y) {
        for (local.x = 0; local.x < valid.x; ++local.x) visit(first + local);
      }
    }
  }
  return true;
}

// Where grid lines between voxel centres cross phi = 0, in mm along the grid's axes from its first voxel. A
// crossing has a voxel inside at one of its ends. Fails (ErrorKind::cancelled).
Result<std::vector<glm::vec3>> surface_crossings(const Field& phi, const Progress& progress = {});

}  // namespace tidemark::solver
