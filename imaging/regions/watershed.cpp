#include "imaging/regions/watershed.h"

#include <itkImage.h>
#include <itkSignedMaurerDistanceMapImageFilter.h>

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <queue>

#include "imaging/regions/islands.h"

namespace tidemark::imaging {
namespace {

constexpr std::uint8_t kNoPart = 0;
constexpr std::int64_t kVoxelsBetweenLooks = 1 << 16;  // at the progress

// The voxels of a box, i fastest.
class Box {
 public:
  explicit Box(const VoxelRange& range) : low_(range.low) { grid_.size = range.high - range.low; }

  [[nodiscard]] const Index3& size() const { return grid_.size; }
  [[nodiscard]] std::int64_t voxels() const { return grid_.voxel_count(); }
  [[nodiscard]] std::int64_t offset(Index3 voxel) const { return grid_.offset(voxel - low_); }
  [[nodiscard]] Index3 voxel(std::int64_t offset) const { return low_ + grid_.voxel_at(offset); }

 private:
  Index3 low_;
  Geometry grid_;
};

// mm, above 0 inside of the region. Beyond the box nothing is known, and nothing ends there.
std::vector<float> distances(const Region& region, const Box& box, const Geometry& grid) {
  using Inside = itk::Image<std::uint8_t, 3>;
  using Distances = itk::Image<float, 3>;
  const auto inside = Inside::New();
  Inside::RegionType all;
  for (unsigned axis = 0; axis < 3; ++axis)
    all.SetSize(axis, static_cast<itk::SizeValueType>(box.size()[static_cast<int>(axis)]));
  inside->SetRegions(all);
  const std::array spacing{grid.spacing_mm.x, grid.spacing_mm.y, grid.spacing_mm.z};
  inside->SetSpacing(spacing.data());
  inside->Allocate(true);
  std::uint8_t* const values = inside->GetBufferPointer();
  region.for_each_run([&](Index3 voxel, std::int64_t length) {
    std::fill_n(values + box.offset(voxel), length, std::uint8_t{1});
  });
  const auto filter = itk::SignedMaurerDistanceMapImageFilter<Inside, Distances>::New();
  filter->SetInput(inside);
  filter->SquaredDistanceOff();
  filter->UseImageSpacingOn();
  filter->InsideIsPositiveOn();
  filter->Update();
  const float* const first = filter->GetOutput()->GetBufferPointer();
  return {first, first + box.voxels()};
}

// The flood of a region: voxels in the order in which they are taken.
class Flood {
 public:
  Flood(const Region& region, const Geometry& grid)
      : region_(region),
        box_(region.bounds().widened(Index3(1), grid.size)),
        distance_mm_(distances(region, box_, grid)),
        parts_(distance_mm_.size(), kNoPart) {}

  [[nodiscard]] std::uint8_t part(Index3 voxel) const { return parts_[at(voxel)]; }
  void take(Index3 voxel, std::uint8_t part) {
    parts_[at(voxel)] = part;
    open_.push({distance_mm_[at(voxel)], turn_++, box_.offset(voxel)});
  }
  // From a voxel that was taken uphill, to the middle of its part: a seed near the border would else be late.
  void climb(Index3 from) {
    for (Index3 here = from;;) {
      Index3 best = here;
      for_each_neighbour(here, [&](Index3 there) {
        if (distance_mm_[at(there)] > distance_mm_[at(best)]) best = there;
      });
      const bool is_free = best != here && parts_[at(best)] == kNoPart;
      if (!is_free) return;
      take(best, parts_[at(from)]);
      here = best;
    }
  }
  // Takes the neighbours of the deepest voxel that has not been looked at. False: there is none.
  bool step() {
    if (open_.empty()) return false;
    const Index3 here = box_.voxel(open_.top().voxel);
    open_.pop();
    for_each_neighbour(here, [&](Index3 there) {
      if (parts_[at(there)] == kNoPart) take(there, parts_[at(here)]);
    });
    return true;
  }
  [[nodiscard]] float depth_mm(Index3 voxel) const { return distance_mm_[at(voxel)]; }

 private:
  struct Drop {
    float distance = 0.0F;
    std::int64_t turn = 0;  // among equals the first come
    std::int64_t voxel = 0;
    bool operator<(const Drop& other) const {
      return distance != other.distance ? distance < other.distance : turn > other.turn;
    }
  };
  [[nodiscard]] std::size_t at(Index3 voxel) const { return static_cast<std::size_t>(box_.offset(voxel)); }
  template <class Visit>
  void for_each_neighbour(Index3 voxel, const Visit& visit) const {
    for (int axis = 0; axis < 3; ++axis) {
      for (const std::int64_t way : {-1, 1}) {
        Index3 there = voxel;
        there[axis] += way;
        if (region_.contains(there)) visit(there);
      }
    }
  }

  const Region& region_;
  Box box_;
  std::vector<float> distance_mm_;
  std::vector<std::uint8_t> parts_;
  std::priority_queue<Drop> open_;
  std::int64_t turn_ = 0;
};

template <class Visit>
void for_each_voxel(const Region& region, const Visit& visit) {
  region.for_each_run([&](Index3 first, std::int64_t length) {
    for (std::int64_t i = 0; i < length; ++i) visit(first + Index3(i, 0, 0));
  });
}

}  // namespace

Result<std::vector<Region>> watershed(const Region& region, const Region& seeds, const Geometry& grid,
                                      const Progress& progress) {
  const Islands islands(seeds);
  if (islands.count() > kMostSeeds)
    return fail(ErrorKind::usage, "there are {} seeds: at most {} divide a region", islands.count(),
                kMostSeeds);
  const Region all = united(region, seeds);
  if (all.empty()) return std::vector<Region>(islands.count());
  // ITK's watershed from markers knows no mask: it would flood all of the box.
  Flood flood(all, grid);
  std::vector<Index3> deepest(islands.count(), Index3(-1));
  for_each_voxel(seeds, [&](Index3 voxel) {
    const std::size_t island = *islands.at(voxel);
    flood.take(voxel, static_cast<std::uint8_t>(island + 1));
    Index3& best = deepest[island];
    if (best.x < 0 || flood.depth_mm(voxel) > flood.depth_mm(best)) best = voxel;
  });
  for (const Index3& voxel : deepest) flood.climb(voxel);
  const auto whole = static_cast<double>(all.count());
  for (std::int64_t done = 0; flood.step(); ++done) {
    if (done % kVoxelsBetweenLooks != 0) continue;
    if (progress.cancelled()) return cancelled_error();
    progress(static_cast<double>(done) / whole, "watershed");
  }
  const auto for_each_taken = [&](const auto& visit) {
    for_each_voxel(all, [&](Index3 voxel) {
      if (flood.part(voxel) != kNoPart) visit(voxel, flood.part(voxel) - 1U);
    });
  };
  std::vector<VoxelRange> boxes(islands.count(), VoxelRange{grid.size, Index3(0)});
  for_each_taken([&](Index3 voxel, std::size_t part) {
    boxes[part].low = glm::min(boxes[part].low, voxel);
    boxes[part].high = glm::max(boxes[part].high, voxel + Index3(1));
  });
  std::vector<Region> results(boxes.begin(), boxes.end());
  for_each_taken([&](Index3 voxel, std::size_t part) { results[part].add(voxel); });
  return results;
}

}  // namespace tidemark::imaging
