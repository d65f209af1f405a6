#include <algorithm>
#include <new>

#include "imaging/files/picture.h"
#include "imaging/files/stored_voxels.h"
#include "imaging/files/volume_file.h"
#include "imaging/files/volume_header.h"
#include "imaging/guard/file_stamp.h"

namespace tidemark::imaging {

bool is_readable_volume_file(const std::filesystem::path& file) {
  return files::format_of(file).has_value() || is_picture_file(file);
}

bool is_picture_file(const std::filesystem::path& file) {
  return files::picture_format_of(file).has_value();
}

namespace {

using files::VolumeHeader;

Series series_of(const std::filesystem::path& file) {
  Series series;
  series.uid = file.filename().string();
  series.description = series.uid;
  series.files = {file};
  return series;
}

void take(Series& series, const VolumeHeader& header) {
  series.loadable = true;
  series.geometry = header.geometry;
  series.scalar = header.scalar;
  series.changes = header.changes;
  series.warnings = header.warnings;
}

// `series`, where it is asked for, gets what the header says.
Result<Volume> read(const std::filesystem::path& file, Series* series, const Progress& progress) {
  const std::string name = file.string();
  const files::ItkScope scope;
  progress(0.0, "reading the volume");
  if (progress.cancelled()) return cancelled_error();
  // The file is opened more than once: by us, and by ITK for its geometry.
  const auto stamp = FileStamp::of(file);
  auto header = files::check_header(file);
  if (!header) return pass_on(header);
  const auto stamp_of_voxels = FileStamp::of(header->layout.file);  // another file where the header says so
  if (series != nullptr) take(*series, *header);
  progress(0.1, "reading the volume");
  if (progress.cancelled()) return cancelled_error();

  Volume volume;
  try {
    auto voxels = files::read_stored_voxels(header->layout);
    if (!voxels) return pass_on(voxels);
    volume.voxels = std::move(*voxels);
  } catch (const std::bad_alloc&) {
    return fail(ErrorKind::capability, "{}: not enough memory for {} voxels", name,
                header->geometry.voxel_count());
  } catch (const std::exception& exception) {
    return fail(ErrorKind::input, "{}: the voxels cannot be read: {}", name, files::one_line(exception));
  }
  TIDEMARK_TRY(require_unchanged(file, stamp.value_or(FileStamp())));
  TIDEMARK_TRY(require_unchanged(header->layout.file, stamp_of_voxels.value_or(FileStamp())));
  if (progress.cancelled()) return cancelled_error();
  volume.geometry = header->geometry;
  volume.description = file.filename().string();
  volume.changes = std::move(header->changes);
  volume.changes.insert(volume.changes.end(), header->warnings.begin(), header->warnings.end());
  TIDEMARK_TRY(require_finite(volume, name));
  progress(1.0, "reading the volume");
  return volume;
}

}  // namespace

Result<Series> scan_volume_file(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) {
    return fail(ErrorKind::input, "{}: no such file", file.string());
  }
  if (is_picture_file(file)) return files::scan_picture(file);
  const files::ItkScope scope;
  Series series = series_of(file);
  const auto header = files::check_header(file);
  if (header) {
    take(series, *header);
  } else {
    series.reason = header.error().message;
  }
  return series;
}

Result<Volume> read_volume_file(const std::filesystem::path& file, const Progress& progress) {
  if (is_picture_file(file)) return files::read_picture(file, progress);
  return read(file, nullptr, progress);
}

Result<VolumeWithSeries> read_volume_with_series(const std::filesystem::path& file,
                                                 const Progress& progress) {
  Series series = series_of(file);
  auto volume = read(file, &series, progress);
  if (!volume) return pass_on(volume);
  return VolumeWithSeries{std::move(series), std::move(*volume)};
}

}  // namespace tidemark::imaging
