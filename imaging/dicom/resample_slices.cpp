#include "imaging/dicom/resample_slices.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <type_traits>

#include "core/thread_pool.h"

namespace tidemark::imaging {
namespace {

// Each thread keeps two slices: all of them together a quarter of the volume at most.
constexpr std::int64_t kSlicesPerThread = 8;

// Where a slice's pixels lie along one axis of the grid. Its outermost pixels are half a voxel wider than
// their centres.
struct Extent {
  std::int64_t begin = 0;  // voxels of the grid
  std::int64_t end = 0;
};

Extent extent_of(double shift, std::int64_t pixels, std::int64_t voxels) {
  const auto begin = static_cast<std::int64_t>(std::ceil(shift - 0.5));
  const auto end = static_cast<std::int64_t>(std::ceil(shift + static_cast<double>(pixels) - 0.5));
  return {std::clamp<std::int64_t>(begin, 0, voxels), std::clamp<std::int64_t>(end, 0, voxels)};
}

// The two pixels between which a voxel lies.
struct Between {
  std::int64_t low = 0;
  std::int64_t high = 0;
  double part = 0.0;  // of the higher one
};

Between between(std::int64_t voxel, double shift, std::int64_t pixels) {
  const double place = std::clamp(static_cast<double>(voxel) - shift, 0.0, static_cast<double>(pixels - 1));
  const auto low = static_cast<std::int64_t>(place);
  return {low, std::min(low + 1, pixels - 1), place - static_cast<double>(low)};
}

template <class Voxel>
class SliceMixer {
 public:
  SliceMixer(const SliceResampling<Voxel>& work, std::vector<Voxel>& voxels, int threads);

  // Makes slice k of the grid where slices cover it.
  bool mix(std::int64_t k, int thread);
  void fill_uncovered(std::int64_t k, Voxel background);
  [[nodiscard]] Voxel smallest() const;

 private:
  struct Decoded {
    std::int64_t slice = -1;
    std::vector<Voxel> pixels;
  };
  // A thread's own.
  struct Desk {
    std::array<Decoded, 2> decoded;  // by even and odd slices: neighbours do not displace each other
    std::vector<double> sum, weight;
    std::optional<Voxel> smallest;
  };

  const Voxel* pixels_of(std::int64_t slice, Desk& desk);
  void add_row(const SliceShare& share, const Voxel* pixels, std::int64_t j, Desk& desk) const;
  Voxel* row(std::int64_t j, std::int64_t k) { return voxels_.data() + size_.x * (j + size_.y * k); }
  [[nodiscard]] Extent columns_of(const SliceShare& share) const {
    return extent_of(share.shift.x, work_.size.x, size_.x);
  }
  [[nodiscard]] Extent rows_of(const SliceShare& share) const {
    return extent_of(share.shift.y, work_.size.y, size_.y);
  }

  const SliceResampling<Voxel>& work_;
  Index3 size_;
  std::vector<Voxel>& voxels_;
  std::vector<Desk> desks_;
};

// All memory is allocated here: threads of a pool must not fail to get it.
template <class Voxel>
SliceMixer<Voxel>::SliceMixer(const SliceResampling<Voxel>& work, std::vector<Voxel>& voxels, int threads)
    : work_(work),
      size_(work.plan.geometry.size),
      voxels_(voxels),
      desks_(static_cast<std::size_t>(threads)) {
  for (Desk& desk : desks_) {
    for (Decoded& decoded : desk.decoded) {
      decoded.pixels.resize(static_cast<std::size_t>(work.size.x * work.size.y));
    }
    desk.sum.resize(static_cast<std::size_t>(size_.x));
    desk.weight.resize(static_cast<std::size_t>(size_.x));
  }
}

template <class Voxel>
const Voxel* SliceMixer<Voxel>::pixels_of(std::int64_t slice, Desk& desk) {
  Decoded& place = desk.decoded[static_cast<std::size_t>(slice % 2)];
  if (place.slice == slice) return place.pixels.data();
  place.slice = -1;
  if (!work_.decode(slice, place.pixels.data())) return nullptr;
  place.slice = slice;
  const Voxel low = *std::min_element(place.pixels.begin(), place.pixels.end());
  desk.smallest = std::min(desk.smallest.value_or(low), low);
  return place.pixels.data();
}

template <class Voxel>
void SliceMixer<Voxel>::add_row(const SliceShare& share, const Voxel* pixels, std::int64_t j,
                                Desk& desk) const {
  const Between rows = between(j, share.shift.y, work_.size.y);
  const Voxel* low = pixels + rows.low * work_.size.x;
  const Voxel* high = pixels + rows.high * work_.size.x;
  const auto at = [&](std::int64_t i) {
    const double a = static_cast<double>(low[i]);
    return a + rows.part * (static_cast<double>(high[i]) - a);
  };
  const Extent columns = columns_of(share);
  for (std::int64_t i = columns.begin; i < columns.end; ++i) {
    const Between pair = between(i, share.shift.x, work_.size.x);
    const double a = at(pair.low);
    const auto place = static_cast<std::size_t>(i);
    desk.sum[place] += share.weight * (pair.part == 0.0 ? a : a + pair.part * (at(pair.high) - a));
    desk.weight[place] += share.weight;
  }
}

template <class Voxel>
bool SliceMixer<Voxel>::mix(std::int64_t k, int thread) {
  Desk& desk = desks_[static_cast<std::size_t>(thread)];
  const GridSlice& mixture = work_.plan.slices[static_cast<std::size_t>(k)];
  std::array<const Voxel*, 2> pixels{};
  for (std::size_t n = 0; n < mixture.size(); ++n) {
    if (mixture[n].weight == 0.0) continue;
    pixels[n] = pixels_of(mixture[n].slice, desk);
    if (pixels[n] == nullptr) return false;
  }
  for (std::int64_t j = 0; j < size_.y; ++j) {
    std::fill(desk.sum.begin(), desk.sum.end(), 0.0);
    std::fill(desk.weight.begin(), desk.weight.end(), 0.0);
    for (std::size_t n = 0; n < mixture.size(); ++n) {
      const Extent rows = rows_of(mixture[n]);
      if (pixels[n] != nullptr && j >= rows.begin && j < rows.end) add_row(mixture[n], pixels[n], j, desk);
    }
    Voxel* target = row(j, k);
    for (std::size_t i = 0; i < desk.sum.size(); ++i) {
      if (desk.weight[i] == 0.0) continue;
      // Where only one of two slices is, its value stands alone.
      const double value = desk.weight[i] < 1.0 ? desk.sum[i] / desk.weight[i] : desk.sum[i];
      target[i] =
          std::is_integral_v<Voxel> ? static_cast<Voxel>(std::lround(value)) : static_cast<Voxel>(value);
    }
  }
  return true;
}

template <class Voxel>
void SliceMixer<Voxel>::fill_uncovered(std::int64_t k, Voxel background) {
  const GridSlice& mixture = work_.plan.slices[static_cast<std::size_t>(k)];
  struct Cover {
    Extent columns, rows;
  };
  std::array<Cover, 2> covers{};
  std::transform(mixture.begin(), mixture.end(), covers.begin(), [&](const SliceShare& share) {
    return share.weight > 0.0 ? Cover{columns_of(share), rows_of(share)} : Cover{};
  });
  for (std::int64_t j = 0; j < size_.y; ++j) {
    Voxel* target = row(j, k);
    for (std::int64_t i = 0; i < size_.x; ++i) {
      const bool is_covered = std::any_of(covers.begin(), covers.end(), [&](const Cover& cover) {
        return i >= cover.columns.begin && i < cover.columns.end && j >= cover.rows.begin &&
               j < cover.rows.end;
      });
      if (!is_covered) target[i] = background;
    }
  }
}

template <class Voxel>
Voxel SliceMixer<Voxel>::smallest() const {
  std::optional<Voxel> smallest;
  for (const Desk& desk : desks_) {
    if (desk.smallest) smallest = std::min(smallest.value_or(*desk.smallest), *desk.smallest);
  }
  return smallest.value_or(Voxel{});
}

template <class Voxel>
bool resample(const SliceResampling<Voxel>& work, std::vector<Voxel>& voxels) {
  const auto count = static_cast<std::int64_t>(work.plan.slices.size());
  ThreadPool pool(
      static_cast<int>(std::clamp<std::int64_t>(count / kSlicesPerThread, 1, available_processors())));
  SliceMixer<Voxel> mixer(work, voxels, pool.threads());
  std::atomic<bool> good{true};
  pool.for_each(count, 1, [&](std::int64_t begin, std::int64_t end, int thread) {
    for (std::int64_t k = begin; k < end && good; ++k) {
      if (!mixer.mix(k, thread)) good = false;
      work.advance();
    }
  });
  const Index3 size = work.plan.geometry.size;
  const bool is_larger = size.x > work.size.x || size.y > work.size.y;
  if (!good || !is_larger) return good;
  const Voxel background = work.background.value_or(mixer.smallest());
  pool.for_each(count, 1, [&](std::int64_t begin, std::int64_t end, int) {
    for (std::int64_t k = begin; k < end; ++k) mixer.fill_uncovered(k, background);
  });
  return true;
}

}  // namespace

template <class Voxel>
bool resample_slices(const SliceResampling<Voxel>& work, std::vector<Voxel>& voxels) {
  return resample(work, voxels);
}

template bool resample_slices(const SliceResampling<std::int16_t>&, std::vector<std::int16_t>&);
template bool resample_slices(const SliceResampling<std::uint16_t>&, std::vector<std::uint16_t>&);
template bool resample_slices(const SliceResampling<float>&, std::vector<float>&);

}  // namespace tidemark::imaging
