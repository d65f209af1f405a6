// A DICOM Segmentation or RT Structure Set, read as labels of a small volume; a Segmentation also onto a grid
// of its own, and as a map, as which a parametric map is read, too.
#include <cmath>
#include <cstdlib>

#include "imaging/dicom/pixels.h"
#include "imaging/results/results.h"
#include "tests/fuzz/scratch_file.h"

namespace {

using namespace tidemark;

// The volume that the seeds were made of.
const Geometry kVolume{{7, 5, 4}};

// Every segment is of voxels of the grid, and what comes of all together fits it.
void check(const imaging::Segments& segments) {
  const Geometry& grid = segments.geometry;
  const glm::dvec3 last = grid.to_patient(grid.size);
  if (!std::isfinite(last.x + last.y + last.z)) std::abort();
  const auto area = static_cast<std::size_t>(grid.size.x * grid.size.y);
  for (const imaging::Segment& segment : segments.list) {
    for (const auto& [k, slice] : segment.slices) {
      if (k < 0 || k >= grid.size.z || slice.size() != area) std::abort();
    }
  }
  // A grid from one end of a patient to the other, which is allowed, is more memory than an input may take.
  constexpr std::int64_t kMostVoxels = std::int64_t{16} << 20;
  if (grid.voxel_count() > kMostVoxels) return;
  const Mask mask = imaging::union_of(segments);
  const auto map = imaging::label_map_of(segments);
  if (map && map->voxels.size() != mask.voxels.size()) std::abort();
}

}  // namespace

// DCMTK reads its data dictionary once, which takes longer than an input may.
extern "C" int LLVMFuzzerInitialize(int*, char***) {
  static_cast<void>(imaging::decode_frame({}));
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count) {
  static fuzz::ScratchFile scratch;
  const auto file = scratch.write("result.dcm", bytes, count);
  if (const auto segments = imaging::read_result(file, &kVolume)) check(*segments);
  if (const auto segments = imaging::read_result(file, nullptr)) check(*segments);
  const auto map = imaging::read_map(file);
  if (map && static_cast<std::int64_t>(map->volume.values().size()) != map->volume.geometry.voxel_count())
    std::abort();
  return 0;
}
