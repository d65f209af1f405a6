#include "imaging/regions/fill_slices.h"

#include <itkImage.h>
#include <itkSignedMaurerDistanceMapImageFilter.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace tidemark::imaging {
namespace {

// Slices along an axis, each a plane of the box around the region and a voxel beside it.
class Slices {
 public:
  Slices(const Region& region, const Geometry& grid, int axis)
      : region_(region),
        axis_(axis),
        across_{axis == 0 ? 1 : 0, axis == 2 ? 1 : 2},
        bounds_(region.bounds()),
        box_(bounds_.widened(Index3(1), grid.size)),
        spacing_mm_{grid.spacing_mm[across_[0]], grid.spacing_mm[across_[1]]} {
    held_.resize(static_cast<std::size_t>(bounds_.high[axis] - bounds_.low[axis]));
    region.for_each_run([&](Index3 voxel, std::int64_t length) {
      const std::int64_t first = voxel[axis_] - bounds_.low[axis_];
      for (std::int64_t n = first; n < first + (axis_ == 0 ? length : 1); ++n)
        held_[static_cast<std::size_t>(n)] = true;
    });
  }

  [[nodiscard]] const VoxelRange& bounds() const { return bounds_; }
  [[nodiscard]] bool holds_voxels(std::int64_t slice) const {
    return held_[static_cast<std::size_t>(slice - bounds_.low[axis_])];
  }
  [[nodiscard]] double smallest_spacing_mm() const { return std::min(spacing_mm_[0], spacing_mm_[1]); }
  [[nodiscard]] std::array<std::int64_t, 2> size() const {
    return {box_.high[across_[0]] - box_.low[across_[0]], box_.high[across_[1]] - box_.low[across_[1]]};
  }
  [[nodiscard]] Index3 voxel(std::int64_t slice, std::int64_t x, std::int64_t y) const {
    Index3 voxel = box_.low;
    voxel[axis_] = slice;
    voxel[across_[0]] += x;
    voxel[across_[1]] += y;
    return voxel;
  }
  // Of each voxel of the slice's plane, mm, above 0 inside; 0 in the outermost voxels inside.
  [[nodiscard]] std::vector<float> distances(std::int64_t slice) const {
    using Plane = itk::Image<std::uint8_t, 2>;
    using Distances = itk::Image<float, 2>;
    const auto plane = Plane::New();
    const auto [width, height] = size();
    Plane::RegionType all;
    all.SetSize({static_cast<itk::SizeValueType>(width), static_cast<itk::SizeValueType>(height)});
    plane->SetRegions(all);
    plane->SetSpacing(spacing_mm_.data());
    plane->Allocate();
    std::uint8_t* value = plane->GetBufferPointer();
    for (std::int64_t y = 0; y < height; ++y) {
      for (std::int64_t x = 0; x < width; ++x) *value++ = region_.contains(voxel(slice, x, y)) ? 1 : 0;
    }
    const auto filter = itk::SignedMaurerDistanceMapImageFilter<Plane, Distances>::New();
    filter->SetInput(plane);
    filter->SquaredDistanceOff();
    filter->UseImageSpacingOn();
    filter->InsideIsPositiveOn();
    filter->Update();
    const float* const first = filter->GetOutput()->GetBufferPointer();
    return {first, first + width * height};
  }

 private:
  const Region& region_;
  int axis_;
  std::array<int, 2> across_;
  VoxelRange bounds_;
  VoxelRange box_;
  std::array<double, 2> spacing_mm_;
  std::vector<bool> held_;
};

}  // namespace

Result<Region> with_slices_filled(const Region& region, const Geometry& grid, int axis,
                                  const Progress& progress) {
  const Slices slices(region, grid, axis);
  const VoxelRange bounds = slices.bounds();
  Region filled = united(region, Region(bounds));
  // Outlines run between voxels: half a voxel from the outermost inside.
  const auto outline = static_cast<float>(-0.5 * slices.smallest_spacing_mm());
  const auto [width, height] = slices.size();
  bool any = false;
  std::int64_t before = bounds.low[axis];
  for (std::int64_t behind = before + 1; behind < bounds.high[axis]; ++behind) {
    if (!slices.holds_voxels(behind)) continue;
    if (progress.cancelled()) return cancelled_error();
    if (behind - before > 1) {
      any = true;
      const std::vector<float> from = slices.distances(before);
      const std::vector<float> to = slices.distances(behind);
      for (std::int64_t slice = before + 1; slice < behind; ++slice) {
        const float share = static_cast<float>(slice - before) / static_cast<float>(behind - before);
        for (std::int64_t y = 0, at = 0; y < height; ++y) {
          for (std::int64_t x = 0; x < width; ++x, ++at) {
            const auto n = static_cast<std::size_t>(at);
            if ((1.0F - share) * from[n] + share * to[n] > outline) filled.add(slices.voxel(slice, x, y));
          }
        }
      }
      progress(static_cast<double>(behind - bounds.low[axis]) /
                   static_cast<double>(bounds.high[axis] - bounds.low[axis]),
               "slices");
    }
    before = behind;
  }
  if (!any) return fail(ErrorKind::usage, "no empty slice lies between others of the label");
  return filled;
}

}  // namespace tidemark::imaging
