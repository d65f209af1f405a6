#include <algorithm>
#include <atomic>
#include <limits>
#include <mutex>
#include <new>
#include <optional>
#include <utility>
#include <vector>

#include "core/checked.h"
#include "core/thread_pool.h"
#include "imaging/dicom/dicom.h"
#include "imaging/dicom/pixels.h"
#include "imaging/dicom/shared_progress.h"

namespace tidemark {
namespace {

std::string first_file(const Series& series) {
  return series.files.empty() ? series.uid : series.files.front().string();
}

// What the slices say together, and the first error among them. Shared by the decoding threads.
class Outcome {
 public:
  [[nodiscard]] bool has_failed() const { return failed_.load(std::memory_order_relaxed); }

  void fail_with(Error error, std::int64_t slice) {
    const std::lock_guard lock(mutex_);
    // The error of the first slice, so that the same files always give the same message.
    if (!error_ || slice < error_slice_) {
      error_ = std::move(error);
      error_slice_ = slice;
    }
    failed_.store(true, std::memory_order_relaxed);
  }
  void count_ignored_bits() { ignored_bits_.fetch_add(1, std::memory_order_relaxed); }

  [[nodiscard]] const std::optional<Error>& error() const { return error_; }
  [[nodiscard]] int ignored_bits() const { return ignored_bits_.load(); }

 private:
  std::atomic<bool> failed_{false};
  std::atomic<int> ignored_bits_{0};
  std::mutex mutex_;
  std::optional<Error> error_;
  std::int64_t error_slice_ = 0;
};

// A decoder of whole series into voxels of one type.
template <class Voxel>
class SeriesDecoder {
 public:
  SeriesDecoder(const Series& series, const SliceHeader& first) : series_(series), first_(first) {}

  // Into `voxels`, which has the size of the whole volume.
  void decode(std::vector<Voxel>& voxels, const Progress& progress, Outcome& outcome) {
    const auto count = static_cast<std::int64_t>(series_.files.size());
    const std::int64_t slice_voxels = series_.geometry.size.x * series_.geometry.size.y;
    SharedProgress shared(progress, count, "decoding slices");
    ThreadPool pool;
    pool.for_each(count, 1, [&](std::int64_t begin, std::int64_t end, int) {
      for (std::int64_t k = begin; k < end && !progress.cancelled() && !outcome.has_failed(); ++k) {
        decode_one(k, voxels.data() + k * slice_voxels, outcome);
        shared.advance();
      }
    });
  }

 private:
  void decode_one(std::int64_t k, Voxel* target, Outcome& outcome) {
    const auto& file = series_.files[static_cast<std::size_t>(k)];
    auto slice = decode_slice(file);
    if (!slice) return outcome.fail_with(std::move(slice.error()), k);
    if (slice->ignored_bits) outcome.count_ignored_bits();
    if (!fits(*slice)) {
      return outcome.fail_with(
          {ErrorKind::input, file.string() + ": is not what it was when its series was listed"}, k);
    }
    const double slope = series_.value_scale * slice->header.slope;
    const double intercept = series_.value_scale * slice->header.intercept;
    std::transform(slice->stored.begin(), slice->stored.end(), target, [&](std::int32_t stored) {
      if constexpr (std::is_same_v<Voxel, float>) {
        return static_cast<float>(slope * static_cast<double>(stored) + intercept);
      } else {
        return static_cast<Voxel>(stored);
      }
    });
  }

  // Whether the slice still is of the series' size and its values fit the voxel type.
  bool fits(const SlicePixels& slice) const {
    const SliceHeader& header = slice.header;
    if (header.columns != series_.geometry.size.x || header.rows != series_.geometry.size.y) return false;
    if constexpr (std::is_same_v<Voxel, float>) {
      return true;
    } else {
      if (header.slope != first_.slope || header.intercept != first_.intercept) return false;
      std::int32_t low = 0;  // which every type holds
      std::int32_t high = 0;
      for (const std::int32_t value : slice.stored) {
        low = std::min(low, value);
        high = std::max(high, value);
      }
      return low >= std::numeric_limits<Voxel>::min() && high <= std::numeric_limits<Voxel>::max();
    }
  }

  const Series& series_;
  const SliceHeader& first_;
};

template <class Voxel>
Status decode_into(const Series& series, const SliceHeader& first, Volume& volume, const Progress& progress) {
  std::vector<Voxel> voxels(static_cast<std::size_t>(series.geometry.voxel_count()));
  Outcome outcome;
  SeriesDecoder<Voxel>(series, first).decode(voxels, progress, outcome);
  if (outcome.error()) return tl::unexpected(*outcome.error());
  if (progress.cancelled()) return cancelled_error();
  if (outcome.ignored_bits() > 0) {
    volume.changes.push_back(
        fmt::format("bits outside BitsStored were set in {} slices and are ignored", outcome.ignored_bits()));
  }
  volume.voxels = std::move(voxels);
  return {};
}

Result<Volume> load(const Series& series, const Progress& progress) {
  if (!series.loadable) {
    return fail(ErrorKind::input, "{}: the series cannot be loaded: {}", first_file(series), series.reason);
  }
  const Index3 size = series.geometry.size;
  const auto count = checked_product(size.x, size.y, size.z);
  if (!count || *count == 0 || size.z != static_cast<std::int64_t>(series.files.size())) {
    return fail(ErrorKind::input, "{}: the series has {} files for {} slices", first_file(series),
                series.files.size(), size.z);
  }
  // The first slice tells what all have in common.
  auto first = decode_slice(series.files.front());
  if (!first) return pass_on(first);

  Volume volume;
  volume.geometry = series.geometry;
  volume.modality = series.modality;
  volume.description = series.description;
  volume.unit = series.unit;
  if (const auto window = first->header.window) {
    volume.window = {series.value_scale * window->centre, series.value_scale * window->width};
  }
  volume.changes = series.changes;
  volume.changes.insert(volume.changes.end(), series.warnings.begin(), series.warnings.end());
  if (series.scalar != "float") {
    volume.slope = series.value_scale * first->header.slope;
    volume.intercept = series.value_scale * first->header.intercept;
  }
  const Status decoded =
      series.scalar == "int16"    ? decode_into<std::int16_t>(series, first->header, volume, progress)
      : series.scalar == "uint16" ? decode_into<std::uint16_t>(series, first->header, volume, progress)
                                  : decode_into<float>(series, first->header, volume, progress);
  if (!decoded) return tl::unexpected(decoded.error());
  return volume;
}

}  // namespace

Result<Volume> load_dicom(const Series& series, const Progress& progress) {
  try {
    return load(series, progress);
  } catch (const std::bad_alloc&) {
    return fail(ErrorKind::capability, "{}: there is not enough memory for {} x {} x {} voxels",
                first_file(series), series.geometry.size.x, series.geometry.size.y, series.geometry.size.z);
  } catch (const std::exception& error) {
    return fail(ErrorKind::input, "{}: cannot be read: {}", first_file(series), error.what());
  }
}

}  // namespace tidemark
