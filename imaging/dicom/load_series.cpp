#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <mutex>
#include <new>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "core/checked.h"
#include "core/large_pages.h"
#include "core/thread_pool.h"
#include "imaging/dicom/dicom.h"
#include "imaging/dicom/frame_plan.h"
#include "imaging/dicom/resample_slices.h"
#include "imaging/dicom/shared_progress.h"

namespace tidemark::imaging {
namespace {

constexpr double kAir = -1024.0;  // HU, the smallest value of most scanners

std::string first_file(const Series& series) {
  return series.files.empty() ? series.uid : series.files.front().string();
}

// The joint findings of the slices, and the first error among them. Shared by the decoding threads.
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
  // A slice may be decoded more than once.
  void note_ignored_bits(std::int64_t slice) {
    const std::lock_guard lock(mutex_);
    ignored_bits_.insert(slice);
  }

  [[nodiscard]] const std::optional<Error>& error() const { return error_; }
  [[nodiscard]] std::size_t ignored_bits() const { return ignored_bits_.size(); }

 private:
  std::atomic<bool> failed_{false};
  std::mutex mutex_;
  std::set<std::int64_t> ignored_bits_;  // slices that have them
  std::optional<Error> error_;
  std::int64_t error_slice_ = 0;
};

// A decoder of whole series into voxels of one type.
template <class Voxel>
class SeriesDecoder {
 public:
  SeriesDecoder(const Series& series, const SliceHeader& first, FramePlan& plan)
      : series_(series), first_(first), plan_(plan) {}

  // Into `voxels`, which has the size of the whole volume.
  void decode(std::vector<Voxel>& voxels, const Progress& progress, Outcome& outcome) {
    if (series_.grid.slices.empty()) {
      decode_slices(voxels, progress, outcome);
    } else {
      resample(voxels, progress, outcome);
    }
  }

 private:
  // Each slice of the volume is one image.
  void decode_slices(std::vector<Voxel>& voxels, const Progress& progress, Outcome& outcome) {
    const auto count = static_cast<std::int64_t>(plan_.work().size());
    SharedProgress shared(progress, count, "decoding slices");
    const std::int64_t slice_voxels = series_.stack.size.x * series_.stack.size.y;
    const auto place = [&](std::int64_t k) { return voxels.data() + k * slice_voxels; };
    ThreadPool pool;
    pool.for_each(count, 1, [&](std::int64_t begin, std::int64_t end, int) {
      for (std::int64_t w = begin; w < end && !progress.cancelled() && !outcome.has_failed(); ++w) {
        decode_frame(plan_.work()[static_cast<std::size_t>(w)], place, outcome);
        shared.advance();
      }
    });
  }

  // Slices of the volume are made of images by the series' grid.
  void resample(std::vector<Voxel>& voxels, const Progress& progress, Outcome& outcome) {
    SharedProgress shared(progress, series_.geometry.size.z, "decoding slices");
    std::vector<const FrameWork*> work_of(series_.sources.size());
    for (const FrameWork& work : plan_.work()) {
      for (const std::int64_t k : work.slices) work_of[static_cast<std::size_t>(k)] = &work;
    }
    const auto decode = [&](std::int64_t k, Voxel* target) {
      if (progress.cancelled() || outcome.has_failed()) return false;
      const auto place = [&](std::int64_t slice) { return slice == k ? target : nullptr; };
      decode_frame(*work_of[static_cast<std::size_t>(k)], place, outcome);
      return !outcome.has_failed();
    };
    resample_slices<Voxel>(
        {series_.grid, series_.stack.size, decode, [&] { shared.advance(); }, background()}, voxels);
  }

  // The value of voxels that no image covers: the images' padding value, else air.
  std::optional<Voxel> background() const {
    std::optional<double> stored = first_.padding;
    if (!stored && first_.modality == "CT") stored = (kAir - first_.intercept) / first_.slope;
    if (!stored) return std::nullopt;
    if constexpr (std::is_same_v<Voxel, float>) {
      return static_cast<float>(series_.value_scale * (first_.slope * *stored + first_.intercept));
    } else {
      using Limits = std::numeric_limits<Voxel>;
      return static_cast<Voxel>(std::lround(std::clamp<double>(*stored, Limits::min(), Limits::max())));
    }
  }

  // Into place(k), for those of its slices k that have one.
  template <class Place>
  void decode_frame(const FrameWork& work, const Place& place, Outcome& outcome) {
    const auto reader = plan_.open(work);
    if (!reader) return outcome.fail_with(reader.error(), work.slices.front());
    if (are_voxels(**reader)) {
      for (const std::int64_t k : work.slices) read_slice(**reader, k, place(k), outcome);
      return plan_.is_done(work);
    }
    const auto pixels = (*reader)->decode(work.frame);
    if (!pixels) return outcome.fail_with(pixels.error(), work.slices.front());
    for (const std::int64_t k : work.slices) {
      Voxel* target = place(k);
      if (target == nullptr) continue;
      if (pixels->ignored_bits) outcome.note_ignored_bits(k);
      put_slice(**reader, *pixels, k, target, outcome);
    }
    plan_.is_done(work);
  }

  // Whether a frame of the file is a slice, and its words are voxels.
  static bool are_voxels(const FrameReader& reader) {
    return std::is_integral_v<Voxel> && reader.slices().front().tiles == 1 &&
           reader.has_words(std::is_signed_v<Voxel>);
  }

  void read_slice(const FrameReader& reader, std::int64_t k, Voxel* target, Outcome& outcome) {
    if (target == nullptr || header_of(reader, k, outcome) == nullptr) return;
    const auto voxels = static_cast<std::size_t>(series_.stack.size.x * series_.stack.size.y);
    const std::int64_t frame = series_.sources[static_cast<std::size_t>(k)].frame;
    const auto ignored_bits = reader.read_words(frame, {reinterpret_cast<std::uint16_t*>(target), voxels});
    if (!ignored_bits) return outcome.fail_with(ignored_bits.error(), k);
    if (*ignored_bits) outcome.note_ignored_bits(k);
  }

  // Null, and a failure, where the slice does not suit the series.
  const SliceHeader* header_of(const FrameReader& reader, std::int64_t k, Outcome& outcome) const {
    const SliceSource& source = series_.sources[static_cast<std::size_t>(k)];
    const SliceHeader* header = reader.slice(source.frame, source.tile);
    if (header != nullptr && has_kind(*header)) return header;
    outcome.fail_with(
        {ErrorKind::input, source.file.string() + ": is not what it was when its series was listed"}, k);
    return nullptr;
  }

  void put_slice(const FrameReader& reader, const FramePixels& pixels, std::int64_t k, Voxel* target,
                 Outcome& outcome) {
    const SliceSource& source = series_.sources[static_cast<std::size_t>(k)];
    const SliceHeader* header = header_of(reader, k, outcome);
    if (header == nullptr) return;
    const Index3 size = series_.stack.size;
    const std::int64_t across = header->frame_columns / size.x;
    const std::int64_t corner =
        source.tile / across * size.y * header->frame_columns + source.tile % across * size.x;
    const double slope = series_.value_scale * header->slope;
    const double intercept = series_.value_scale * header->intercept;
    bool fits = true;
    for (std::int64_t j = 0; j < size.y; ++j) {
      const auto row = pixels.stored.begin() + corner + j * header->frame_columns;
      std::transform(row, row + size.x, target + j * size.x,
                     [&](std::int32_t stored) { return voxel(stored, slope, intercept, fits); });
    }
    if (!fits) {
      outcome.fail_with(
          {ErrorKind::input, source.file.string() + ": holds values beyond what its header says"}, k);
    }
  }

  static Voxel voxel(std::int32_t stored, double slope, double intercept, bool& fits) {
    if constexpr (std::is_same_v<Voxel, float>) {
      return static_cast<float>(slope * static_cast<double>(stored) + intercept);
    } else {
      fits &= stored >= std::numeric_limits<Voxel>::min() && stored <= std::numeric_limits<Voxel>::max();
      return static_cast<Voxel>(stored);
    }
  }

  // Whether the slice still suits the series.
  [[nodiscard]] bool has_kind(const SliceHeader& header) const {
    if (header.columns != series_.stack.size.x || header.rows != series_.stack.size.y) return false;
    return std::is_same_v<Voxel, float> ||
           (header.slope == first_.slope && header.intercept == first_.intercept);
  }

  const Series& series_;
  const SliceHeader& first_;
  FramePlan& plan_;
};

template <class Voxel>
Status decode_into(const Series& series, const SliceHeader& first, FramePlan& plan, Volume& volume,
                   const Progress& progress) {
  auto voxels = make_large_vector<Voxel>(static_cast<std::size_t>(series.geometry.voxel_count()));
  Outcome outcome;
  SeriesDecoder<Voxel>(series, first, plan).decode(voxels, progress, outcome);
  if (outcome.error()) return tl::unexpected(*outcome.error());
  if (progress.cancelled()) return cancelled_error();
  if (outcome.ignored_bits() > 0) {
    volume.changes.push_back(
        fmt::format("bits outside BitsStored were set in {} slices and are ignored", outcome.ignored_bits()));
  }
  volume.voxels = std::move(voxels);
  return {};
}

// The header of the first slice has the attributes that all share.
Result<SliceHeader> first_header(const Series& series, FramePlan& plan) {
  const SliceSource& source = series.sources.front();
  const auto reader = plan.open(plan.work().front());
  if (!reader) return pass_on(reader);
  const SliceHeader* header = (*reader)->slice(source.frame, source.tile);
  if (header != nullptr) return *header;
  return fail(ErrorKind::input, "{}: is not what it was when its series was listed", source.file.string());
}

Result<Volume> load(const Series& series, const Progress& progress) {
  if (!series.loadable) {
    return fail(ErrorKind::input, "{}: the series cannot be loaded: {}", first_file(series), series.reason);
  }
  const Index3 size = series.geometry.size;
  const auto count = checked_product(size.x, size.y, size.z);
  const auto& planned = series.grid.slices;
  if (!count || *count == 0 ||
      size.z != static_cast<std::int64_t>(planned.empty() ? series.sources.size() : planned.size())) {
    return fail(ErrorKind::input, "{}: the series has {} images for {} slices", first_file(series),
                series.sources.size(), size.z);
  }
  FramePlan plan(series);
  const auto first = first_header(series, plan);
  if (!first) return pass_on(first);

  Volume volume;
  volume.geometry = series.geometry;
  volume.modality = series.modality;
  volume.description = series.description;
  volume.unit = series.unit;
  if (const auto& window = first->window) {
    volume.window = {series.value_scale * window->centre, series.value_scale * window->width};
  }
  volume.changes = series.changes;
  volume.changes.insert(volume.changes.end(), series.warnings.begin(), series.warnings.end());
  if (series.scalar != "float") {
    volume.slope = series.value_scale * first->slope;
    volume.intercept = series.value_scale * first->intercept;
  }
  const Status decoded =
      series.scalar == "int16"    ? decode_into<std::int16_t>(series, *first, plan, volume, progress)
      : series.scalar == "uint16" ? decode_into<std::uint16_t>(series, *first, plan, volume, progress)
                                  : decode_into<float>(series, *first, plan, volume, progress);
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

}  // namespace tidemark::imaging
