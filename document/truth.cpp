#include "document/truth.h"

#include "imaging/load_study.h"
#include "imaging/onto_grid.h"
#include "imaging/results/results.h"

namespace tidemark::document {
namespace {

// By its number in a DICOM segmentation, by its place in a structure set, whose segments have none.
bool is_meant(const imaging::Segment& segment, std::size_t place, std::int64_t label) {
  const std::size_t number = segment.number != 0 ? segment.number : place + 1;
  return static_cast<std::int64_t>(number) == label;
}

Result<BitMask> true_segments(const std::filesystem::path& file, std::optional<std::int64_t> label,
                              const Geometry& grid) {
  auto segments = imaging::read_result(file, &grid);
  if (!segments) return pass_on(segments);
  if (label) {
    std::vector<imaging::Segment> meant;
    for (std::size_t n = 0; n < segments->list.size(); ++n) {
      if (is_meant(segments->list[n], n, *label)) meant.push_back(std::move(segments->list[n]));
    }
    if (meant.empty()) {
      return fail(ErrorKind::usage, "{}: {} has no segment of that number", *label, file.string());
    }
    segments->list = std::move(meant);
  }
  return BitMask(imaging::union_of(*segments));
}

}  // namespace

Result<BitMask> load_truth(const std::filesystem::path& file, std::optional<std::int64_t> label,
                           const Geometry& grid, const Progress& progress) {
  if (imaging::result_form_of(file)) return true_segments(file, label, grid);
  const auto labels = imaging::load_volume(file, {}, progress);
  if (!labels) return pass_on(labels);
  Mask mask{labels->geometry,
            std::vector<std::uint8_t>(static_cast<std::size_t>(labels->geometry.voxel_count()))};
  for (std::int64_t offset = 0; offset < labels->geometry.voxel_count(); ++offset) {
    const float value = labels->value(offset);
    const bool inside = label ? value == static_cast<float>(*label) : value != 0.0F;
    mask.voxels[static_cast<std::size_t>(offset)] = inside ? 1 : 0;
  }
  const auto placed = imaging::onto_grid(std::move(mask), grid, file.string());
  if (!placed) return pass_on(placed);
  return BitMask(*placed);
}

}  // namespace tidemark::document
