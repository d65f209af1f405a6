#include "imaging/results/segments.h"

#include <algorithm>
#include <cmath>

namespace tidemark::imaging {
namespace {

// Calls visit(offset in voxel order) for every voxel inside.
template <class Visit>
void for_each_voxel(const Segment& segment, const Geometry& geometry, const Visit& visit) {
  for (const auto& [k, slice] : segment.slices) {
    const std::int64_t first = geometry.offset({0, 0, k});
    for (std::size_t i = 0; i < slice.size(); ++i) {
      if (slice[i] != 0) visit(static_cast<std::size_t>(first) + i);
    }
  }
}

// Unless no voxel of it holds `id`.
void add_slice(std::map<std::int64_t, std::vector<std::uint8_t>>& slices, std::int64_t k,
               std::span<const std::uint8_t> voxels, std::uint8_t id) {
  if (std::find(voxels.begin(), voxels.end(), id) == voxels.end()) return;
  std::vector<std::uint8_t>& inside = slices[k];
  inside.resize(voxels.size());
  std::transform(voxels.begin(), voxels.end(), inside.begin(),
                 [&](std::uint8_t voxel) { return std::uint8_t(voxel == id); });
}

}  // namespace

std::int64_t Segment::count() const {
  std::int64_t count = 0;
  for (const auto& [k, slice] : slices) count += std::count(slice.begin(), slice.end(), std::uint8_t{1});
  return count;
}

std::map<std::int64_t, std::vector<std::uint8_t>> slices_of(const Geometry& geometry,
                                                            std::span<const std::uint8_t> voxels,
                                                            std::uint8_t id) {
  std::map<std::int64_t, std::vector<std::uint8_t>> slices;
  const auto area = static_cast<std::size_t>(geometry.size.x * geometry.size.y);
  for (std::int64_t k = 0; (static_cast<std::size_t>(k) + 1) * area <= voxels.size(); ++k)
    add_slice(slices, k, voxels.subspan(static_cast<std::size_t>(k) * area, area), id);
  return slices;
}

std::map<std::int64_t, std::vector<std::uint8_t>> slices_of(const PagedBytes& voxels, std::uint8_t id) {
  std::map<std::int64_t, std::vector<std::uint8_t>> slices;
  const Index3 shape(voxels.size().x, voxels.size().y, 1);
  std::vector<std::uint8_t> slice(static_cast<std::size_t>(shape.x * shape.y));
  for (std::int64_t k = 0; k < voxels.size().z; ++k) {
    voxels.read({0, 0, k}, shape, slice.data());
    add_slice(slices, k, slice, id);
  }
  return slices;
}

Segments segments_of(const Region& region, const Geometry& grid, const std::string& name) {
  Segment segment;
  segment.name = name;
  const auto area = static_cast<std::size_t>(grid.size.x * grid.size.y);
  region.for_each_run([&](Index3 voxel, std::int64_t length) {
    std::vector<std::uint8_t>& slice = segment.slices[voxel.z];
    slice.resize(area);
    std::fill_n(slice.begin() + voxel.y * grid.size.x + voxel.x, length, std::uint8_t{1});
  });
  return {grid, {std::move(segment)}, {}};
}

Segments segments_of(const Mask& mask, const std::string& name) {
  return segments_of(Region(mask), mask.geometry, name);
}

Result<Segments> segments_of_numbers(const Geometry& geometry, std::span<const float> values,
                                     const std::string& what) {
  std::vector<std::uint8_t> ids(values.size());
  std::array<bool, 256> known{};
  for (std::size_t v = 0; v < values.size(); ++v) {
    const float value = values[v];
    if (!(value >= 0.0F && value <= 255.0F) || value != std::floor(value)) {
      return fail(ErrorKind::input, "{}: {} is not a label, a whole number from 0 to 255", what, value);
    }
    ids[v] = static_cast<std::uint8_t>(value);
    known[ids[v]] = true;
  }
  Segments segments{geometry, {}, {}};
  for (std::size_t id = 1; id < known.size(); ++id) {
    if (!known[id]) continue;
    Segment segment;
    segment.name = fmt::format("Segment {}", id);
    segment.slices = slices_of(geometry, ids, static_cast<std::uint8_t>(id));
    segments.list.push_back(std::move(segment));
  }
  if (segments.list.empty()) return fail(ErrorKind::input, "{}: holds no label", what);
  return segments;
}

Region region_of(const Segment& segment, const Geometry& grid) {
  Region region(VoxelRange{Index3(0), grid.size});
  for (const auto& [k, voxels] : segment.slices) {
    for (std::int64_t j = 0; j < grid.size.y; ++j) {
      const std::uint8_t* const row = voxels.data() + j * grid.size.x;
      for (std::int64_t i = 0; i < grid.size.x; ++i) {
        if (row[i] != 0) region.add({i, j, k});
      }
    }
  }
  return region;
}

Mask union_of(const Segments& segments) {
  Mask mask{segments.geometry,
            std::vector<std::uint8_t>(static_cast<std::size_t>(segments.geometry.voxel_count()))};
  for (const Segment& segment : segments.list) {
    for_each_voxel(segment, segments.geometry, [&](std::size_t offset) { mask.voxels[offset] = 1; });
  }
  return mask;
}

Result<LabelMap> label_map_of(const Segments& segments) {
  if (segments.list.size() > 255) {
    return fail(ErrorKind::capability, "{} segments are more than the 255 labels that there can be",
                segments.list.size());
  }
  LabelMap map;
  map.voxels.resize(static_cast<std::size_t>(segments.geometry.voxel_count()));
  std::vector<bool> counted;
  for (std::size_t n = 0; n < segments.list.size(); ++n) {
    for_each_voxel(segments.list[n], segments.geometry, [&](std::size_t offset) {
      std::uint8_t& voxel = map.voxels[offset];
      if (voxel != 0) {
        counted.resize(map.voxels.size());
        if (!counted[offset]) ++map.overlaps;
        counted[offset] = true;
      }
      voxel = static_cast<std::uint8_t>(n + 1);
    });
  }
  return map;
}

}  // namespace tidemark::imaging
