// Regions with names over one grid, which may overlap: what result files hold.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/paged_bytes.h"
#include "core/region.h"
#include "core/volume.h"
#include "imaging/results/segment_meaning.h"

namespace tidemark::imaging {

using SegmentColour = std::array<std::uint8_t, 3>;  // sRGB

struct Segment {
  std::string name;                     // UTF-8
  std::optional<SegmentColour> colour;  // unset: chosen by the viewer
  SegmentMeaning meaning;
  std::uint16_t number = 0;  // SegmentNumber (0062,0004) in a DICOM segmentation; else 0
  // The slices k in which it has voxels: 1 inside, 0 outside, size.x * size.y of them, i fastest.
  std::map<std::int64_t, std::vector<std::uint8_t>> slices;
  // Where there is one, its level set on the same grid (> 0 inside): contours follow it between voxels.
  std::shared_ptr<const Volume> phi;

  [[nodiscard]] std::int64_t count() const;  // voxels inside
};

struct Segments {
  Geometry geometry;
  std::vector<Segment> list;
  std::vector<std::string> changes;  // found and left out by reading, one sentence each
  // The UIDs that a DICOM file names, each once: its places are the study's where these are.
  std::vector<std::string> frames_of_reference = {};
};

// The slices of the voxels that hold `id` (a mask's hold 1). `voxels` are in voxel order.
[[nodiscard]] std::map<std::int64_t, std::vector<std::uint8_t>> slices_of(
    const Geometry& geometry, std::span<const std::uint8_t> voxels, std::uint8_t id = 1);
[[nodiscard]] std::map<std::int64_t, std::vector<std::uint8_t>> slices_of(const PagedBytes& voxels,
                                                                          std::uint8_t id);

// One segment of those voxels.
[[nodiscard]] Segments segments_of(const Region& region, const Geometry& grid, const std::string& name);
[[nodiscard]] Segments segments_of(const Mask& mask, const std::string& name);

// A segment for each number from 1 to 255 that a label map holds, called "Segment 3". `values` are in voxel
// order. Fails (ErrorKind::input) naming `what` (the file) where a value is no label, or none is above 0.
[[nodiscard]] Result<Segments> segments_of_numbers(const Geometry& geometry, std::span<const float> values,
                                                   const std::string& what);

// The voxels of a segment on its grid.
[[nodiscard]] Region region_of(const Segment& segment, const Geometry& grid);

// Everything that is inside any segment.
[[nodiscard]] Mask union_of(const Segments& segments);

// One number a voxel in voxel order: 0 outside, n for the n-th segment, the later one where several overlap.
struct LabelMap {
  std::vector<std::uint8_t> voxels;
  std::int64_t overlaps = 0;  // voxels inside more than one
};
// Fails (ErrorKind::capability) when there are more than 255 segments.
[[nodiscard]] Result<LabelMap> label_map_of(const Segments& segments);

}  // namespace tidemark::imaging
