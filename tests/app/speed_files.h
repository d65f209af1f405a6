// Small inputs for speed functions on the command line.
#pragma once

#include <functional>

#include "tests/app/cli_runner.h"

namespace tidemark::test {

// A folder with
//   ball.nrrd         30^3: 1000 in a ball of 9 mm, 0 outside
//   core.nii.gz, small.nii.gz, large.nii.gz   masks of 4, 6 and 9 mm in its middle
//   map.nii.gz        a probability, high in small.nii.gz
//   walls.nii.gz, anchors.nii.gz   masks: a plate through the ball, a block outside of it
//   textures.nii.gz   44 x 40 x 36: fine mottle in a ball of coarse mottle, of one mean
//   truth.nii.gz      that ball
//   labels.nii.gz     examples: 1 inside, 2 outside
//   second.nrrd, third.nrrd   images of that ball on other grids
class SpeedFiles {
 public:
  SpeedFiles();

  std::filesystem::path operator/(const std::string& name) const { return folder_ / name; }

 private:
  TemporaryFolder folder_;
};

// A volume of that spacing in mm, with value(p) at p in patient mm; origin 0.
Volume volume_of(Index3 size, double spacing_mm, const std::function<double(glm::dvec3)>& value);

// The largest distance in voxels from the centre of a voxel of `mask` to the nearest voxel of `from`, which
// is a cube; both are on one grid.
double farthest_from(const Mask& from, const Mask& mask);

}  // namespace tidemark::test
