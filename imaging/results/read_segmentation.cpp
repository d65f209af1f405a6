#include "imaging/guard/guarded.h"
#include "imaging/results/results.h"
#include "imaging/results/segmentation_file.h"
#include "imaging/results/slice_budget.h"

namespace tidemark::imaging {
namespace {

namespace fs = std::filesystem;

// One reading of one file.
class SegmentationReader {
 public:
  explicit SegmentationReader(const fs::path& file) : object_(file), budget_(file) {}
  Result<Segments> read(const Geometry* grid);

 private:
  Status fill(std::size_t index, Segments& segments);

  SegmentationFile object_;
  SliceBudget budget_;
};

Status SegmentationReader::fill(std::size_t index, Segments& segments) {
  const SegmentFrame& frame = object_.frames().frames[index];
  const Geometry& grid = segments.geometry;
  const auto map = map_frame(frame, grid, object_.file().string());
  if (!map) return pass_on(map);
  TIDEMARK_TRY(object_.pixels().go_to(static_cast<std::int64_t>(index)));
  auto& slices = segments.list[object_.segment_of(frame)].slices;
  for (std::int64_t r = 0; r < object_.format().rows; ++r) {
    for (std::int64_t c = 0; c < object_.format().columns; ++c) {
      if (!object_.pixels().is_inside(r, c)) continue;
      const Index3 voxel = map->first + c * map->column + r * map->row;
      if (!grid.contains(voxel)) {
        return fail(ErrorKind::input, "{}: it reaches beyond the volume", object_.file().string());
      };
      auto& slice = slices[voxel.z];
      if (slice.empty()) {
        TIDEMARK_TRY(budget_.take(grid.size.x * grid.size.y));
        slice.resize(static_cast<std::size_t>(grid.size.x * grid.size.y));
      }
      slice[static_cast<std::size_t>(voxel.x + grid.size.x * voxel.y)] = 1;
    }
  }
  return {};
}

Result<Segments> SegmentationReader::read(const Geometry* grid) {
  TIDEMARK_TRY(object_.load());
  Segments segments;
  if (grid != nullptr) {
    segments.geometry = *grid;
  } else {
    auto own = object_.own_grid();
    if (!own) return pass_on(own);
    segments.geometry = *own;
  }
  segments.list = object_.segments();
  if (const std::string& frame = object_.frame_of_reference_uid(); !frame.empty())
    segments.frames_of_reference = {frame};
  for (std::size_t index = 0; index < object_.frames().frames.size(); ++index) {
    TIDEMARK_TRY(fill(index, segments));
  }
  if (!object_.is_binary()) {
    segments.changes.emplace_back("the segments are fractions; voxels of half and more are inside");
  }
  if (object_.lacks_count()) {
    segments.changes.emplace_back(
        "NumberOfFrames (0028,0008) is missing; the one frame that is described is read");
  }
  return segments;
}

}  // namespace

Result<Segments> read_segmentation(const fs::path& file, const Geometry* grid) {
  return guarded(file, [&] { return SegmentationReader(file).read(grid); });
}

}  // namespace tidemark::imaging
