#include <algorithm>
#include <functional>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <system_error>
#include <utility>
#include <vector>

#include "core/files_below.h"
#include "core/thread_pool.h"
#include "imaging/dicom/dicom.h"
#include "imaging/dicom/dicom_setup.h"
#include "imaging/dicom/header_reader.h"
#include "imaging/dicom/media_directory.h"
#include "imaging/dicom/series_geometry.h"
#include "imaging/dicom/shared_progress.h"
#include "imaging/guard/guarded.h"

namespace tidemark::imaging {
namespace {

namespace fs = std::filesystem;

// The files of one folder that look like DICOM, but nothing says to which series they belong.
struct Damage {
  SkippedFile first;
  std::size_t others = 0;
};

struct Headers {
  std::vector<SliceHeader> slices;
  std::vector<SkippedFile> skipped;
  std::map<fs::path, Damage> damaged;  // of each folder; skipped too
};

// A damaged file, or one with the name of a DICOM file and other bytes in it.
bool may_be_lost_slices(const fs::path& file, Refusal::Kind kind) {
  return kind == Refusal::Kind::damaged || (kind == Refusal::Kind::not_dicom && file.extension() == ".dcm");
}

// A path takes half a kilobyte of memory: none is kept twice.
Result<Headers> read_headers(std::vector<fs::path> files, const Progress& progress) {
  std::vector<std::optional<ImageResult<std::vector<SliceHeader>>>> read(files.size());
  SharedProgress shared(progress, static_cast<std::int64_t>(files.size()), "reading headers");
  ThreadPool pool;
  pool.for_each(static_cast<std::int64_t>(files.size()), 4, [&](std::int64_t begin, std::int64_t end, int) {
    for (std::int64_t i = begin; i < end && !progress.cancelled(); ++i) {
      const auto index = static_cast<std::size_t>(i);
      read[index] = guarded(files[index], [&] { return read_slice_headers(files[index]); });
      shared.advance();
    }
  });
  if (progress.cancelled()) return cancelled_error();

  Headers headers;
  for (std::size_t i = 0; i < files.size(); ++i) {
    ImageResult<std::vector<SliceHeader>>& result = *read[i];
    if (result) {
      std::move(result->begin(), result->end(), std::back_inserter(headers.slices));
      read[i].reset();
      continue;
    }
    std::string reason = without_path(result.error().message, files[i]);
    const bool is_damaged = may_be_lost_slices(files[i], result.error().file_kind);
    read[i].reset();
    if (is_damaged) {
      const auto [folder, is_first] = headers.damaged.try_emplace(files[i].parent_path());
      if (is_first) folder->second.first = {files[i], reason};
      if (!is_first) ++folder->second.others;
    }
    headers.skipped.push_back({std::move(files[i]), std::move(reason)});
  }
  return headers;
}

// A damaged file beside a series may have been its first or last slice, which no gap would show.
void warn_of_damage(std::vector<Series>& series, const std::map<fs::path, Damage>& damaged) {
  if (damaged.empty()) return;
  for (Series& one : series) {
    std::set<fs::path> folders;
    for (const fs::path& file : one.files) folders.insert(file.parent_path());
    for (const fs::path& folder : folders) {
      const auto beside = damaged.find(folder);
      if (beside == damaged.end()) continue;
      const auto& [first, others] = beside->second;
      one.warnings.push_back(fmt::format(
          "{} lies in the same folder and {}{}: a slice may be missing", first.file.filename().string(),
          first.reason, others == 0 ? "" : fmt::format(" (and {} more cannot be read)", others)));
    }
  }
}

Result<Catalogue> catalogue_of(std::vector<fs::path> files, const Progress& progress) {
  auto headers = read_headers(std::move(files), progress);
  if (!headers) return pass_on(headers);
  Catalogue catalogue;
  catalogue.series = group_series(std::move(headers->slices));
  catalogue.skipped = std::move(headers->skipped);
  warn_of_damage(catalogue.series, headers->damaged);
  return catalogue;
}

// A file that a medium's directory names and that is missing may be a series' first or last slice.
void warn_of_missing(Catalogue& catalogue, const fs::path& file, const MediaDirectory& directory) {
  if (directory.missing.count == 0) return;
  catalogue.skipped.push_back({file, fmt::format("refers to {} files that are not there: {}",
                                                 directory.missing.count, list_missing(directory.missing))});
  for (Series& series : catalogue.series) {
    const std::string uid = series.uid.substr(0, series.uid.find('#'));  // of all its parts
    const auto found = directory.missing_of_series.find(uid);
    if (found == directory.missing_of_series.end()) continue;
    series.warnings.push_back(fmt::format("{} names {} files of this series that are not there: {}",
                                          file.filename().string(), found->second.count,
                                          list_missing(found->second)));
  }
}

// Reads all files, also those that no directory of a medium names. Files that a directory names and that are
// missing become a warning of their series.
Result<Catalogue> scan_folder(const fs::path& folder, const Progress& progress) {
  auto files = files_below(folder, progress, {true, true});
  if (!files) return pass_on(files);
  const auto directories = std::stable_partition(
      files->begin(), files->end(), [](const fs::path& file) { return !is_media_directory(file); });
  const std::vector<fs::path> media(directories, files->end());
  files->erase(directories, files->end());
  auto catalogue = catalogue_of(std::move(*files), progress);
  if (!catalogue) return catalogue;
  for (const fs::path& file : media) {
    const auto directory = read_media_directory(file, progress);
    if (directory) {
      warn_of_missing(*catalogue, file, *directory);
    } else if (directory.error().kind == ErrorKind::cancelled) {
      return pass_on(directory);
    } else {
      catalogue->skipped.push_back({file, without_path(directory.error().message, file)});
    }
  }
  return catalogue;
}

// The files that a medium's directory names, and no others.
Result<Catalogue> scan_medium(const fs::path& file, const Progress& progress) {
  const auto directory = read_media_directory(file, progress);
  if (!directory) return pass_on(directory);
  if (directory->files.empty() && directory->missing.count == 0) {
    return fail(ErrorKind::input, "{}: refers to no files", file.string());
  }
  if (directory->files.empty()) {
    return fail(ErrorKind::input, "{}: refers to {} files, none of which is there: {}", file.string(),
                directory->missing.count, list_missing(directory->missing));
  }
  auto catalogue = catalogue_of(directory->files, progress);
  if (catalogue) warn_of_missing(*catalogue, file, *directory);
  return catalogue;
}

// One slice stands for its series: the images of the same series in the same folder.
Result<Catalogue> scan_file(const fs::path& file, const Progress& progress) {
  const auto chosen = read_slice_headers(file);
  if (!chosen) return tl::unexpected<Error>(chosen.error());
  const fs::path folder = file.has_parent_path() ? file.parent_path() : ".";
  SliceHeader placed = chosen->front();
  placed.file = folder / file.filename();  // as the listing names it
  const std::string key = series_key(placed);
  auto files = files_below(folder, progress, {false, true});
  if (!files) return pass_on(files);
  auto headers = read_headers(std::move(*files), progress);
  if (!headers) return pass_on(headers);
  std::erase_if(headers->slices, [&](const SliceHeader& s) { return series_key(s) != key; });
  if (headers->slices.empty()) return fail(ErrorKind::input, "{}: cannot be read", file.string());

  Catalogue catalogue;
  catalogue.series = group_series(std::move(headers->slices));
  // Of several volumes in one series those that the file is part of.
  const auto has_file = [&](const Series& series) {
    return std::find(series.files.begin(), series.files.end(), placed.file) != series.files.end();
  };
  if (std::any_of(catalogue.series.begin(), catalogue.series.end(), has_file)) {
    std::erase_if(catalogue.series, std::not_fn(has_file));
  }
  for (Series& series : catalogue.series) {
    if (series.files.size() < 2) continue;
    series.changes.push_back(
        fmt::format("{} is one of {} images of its series in this folder; all of them are read",
                    file.filename().string(), series.files.size()));
  }
  warn_of_damage(catalogue.series, headers->damaged);
  return catalogue;
}

}  // namespace

Result<Catalogue> scan_dicom(const fs::path& path, const Progress& progress) {
  return guarded(path, [&]() -> Result<Catalogue> {
    TIDEMARK_TRY(set_up_dicom());
    std::error_code error;
    if (fs::is_directory(path, error)) return scan_folder(path, progress);
    if (fs::is_regular_file(path, error)) {
      return is_media_directory(path) ? scan_medium(path, progress) : scan_file(path, progress);
    }
    if (fs::exists(path, error)) {
      return fail(ErrorKind::input, "{}: is neither a file nor a folder", path.string());
    }
    return fail(ErrorKind::input, "{}: no such file or folder", path.string());
  });
}

}  // namespace tidemark::imaging
