#include "imaging/load_study.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <limits>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

#include "core/thread_pool.h"
#include "core/typed_volume.h"
#include "imaging/archive/study_archive.h"
#include "imaging/dicom/dicom.h"
#include "imaging/dicom/series_geometry.h"
#include "imaging/dicom/shared_progress.h"
#include "imaging/files/volume_file.h"
#include "imaging/guard/guarded.h"

namespace tidemark::imaging {
namespace {

namespace fs = std::filesystem;

// DICOM series name their transfer syntaxes; volume files have none.
bool is_volume_file(const Series& series) {
  return series.transfer_syntaxes.empty();
}

// Beside a study pictures are previews and photographs of it: they count where there is nothing else.
void leave_out_pictures(Catalogue& catalogue) {
  const auto is_picture = [](const Series& series) {
    return is_volume_file(series) && is_picture_file(series.files.front());
  };
  const auto pictures =
      std::stable_partition(catalogue.series.begin(), catalogue.series.end(), std::not_fn(is_picture));
  if (pictures == catalogue.series.begin()) return;
  for (auto picture = pictures; picture != catalogue.series.end(); ++picture) {
    catalogue.skipped.push_back(
        {picture->files.front(), "is a picture beside a study, which is opened by itself"});
  }
  catalogue.series.erase(pictures, catalogue.series.end());
}

// Of each file what it holds as a volume file; nothing where its name is that of none.
std::vector<std::optional<Result<Series>>> scan_volume_files(const std::vector<SkippedFile>& files,
                                                             const Progress& progress) {
  std::vector<std::optional<Result<Series>>> scanned(files.size());
  if (files.empty()) return scanned;
  SharedProgress shared(progress, static_cast<std::int64_t>(files.size()), "reading headers");
  ThreadPool pool(reading_threads());
  const auto count = static_cast<std::int64_t>(files.size());
  pool.for_each(count, 4, [&](std::int64_t begin, std::int64_t end, int) {
    for (std::int64_t i = begin; i < end && !progress.cancelled(); ++i) {
      const fs::path& file = files[static_cast<std::size_t>(i)].file;
      if (is_readable_volume_file(file)) scanned[static_cast<std::size_t>(i)] = scan_volume_file(file);
      shared.advance();
    }
  });
  return scanned;
}

// Files that are no DICOM may be volume files.
Result<Catalogue> find_in_folder(const fs::path& folder, const Progress& progress) {
  auto catalogue = scan_dicom(folder, progress.part(0, 2));
  if (!catalogue) return catalogue;
  auto scanned = scan_volume_files(catalogue->skipped, progress.part(1, 2));
  if (progress.cancelled()) return cancelled_error();
  std::vector<SkippedFile> skipped;
  for (std::size_t i = 0; i < scanned.size(); ++i) {
    SkippedFile& candidate = catalogue->skipped[i];
    if (!scanned[i]) {
      if (is_zip_archive(candidate.file)) candidate.reason = "is a zip archive, which is opened by itself";
      skipped.push_back(std::move(candidate));
    } else if (*scanned[i]) {
      catalogue->series.push_back(std::move(**scanned[i]));
    } else {
      skipped.push_back({std::move(candidate.file), std::move(scanned[i]->error().message)});
    }
  }
  catalogue->skipped = std::move(skipped);
  leave_out_pictures(*catalogue);
  return catalogue;
}

// As a folder, whose files are removed with the last holder of a series of it.
Result<Catalogue> find_in_archive(const fs::path& file, const Progress& progress) {
  const auto archive = StudyArchive::unpack(file, progress.part(0, 2));
  if (!archive) return pass_on(archive);
  const StudyArchive& unpacked = **archive;
  auto catalogue = find_in_folder(unpacked.folder(), progress.part(1, 2));
  if (!catalogue) {
    catalogue.error().message = unpacked.name_archive_in(std::move(catalogue.error().message));
    return catalogue;
  }
  for (Series& series : catalogue->series) series.archive = *archive;
  for (SkippedFile& skipped : catalogue->skipped) {
    skipped = {unpacked.name_archive_in(skipped.file.string()), unpacked.name_archive_in(skipped.reason),
               skipped.file};
  }
  const auto& left_out = unpacked.left_out();
  catalogue->skipped.insert(catalogue->skipped.end(), left_out.begin(), left_out.end());
  return catalogue;
}

Result<Catalogue> find_in_file(const fs::path& file, const Progress& progress) {
  if (is_readable_volume_file(file)) {
    auto series = scan_volume_file(file);
    if (!series) return pass_on(series);
    Catalogue catalogue;
    catalogue.series.push_back(std::move(*series));
    return catalogue;
  }
  if (is_zip_archive(file)) return find_in_archive(file, progress);
  if (std::ifstream(file) && !looks_like_dicom(file)) {
    return fail(ErrorKind::input, "{}: is neither a DICOM image, a volume file, a picture nor a zip archive",
                file.string());
  }
  return scan_dicom(file, progress);
}

std::string list_uids(const std::vector<Series>& series) {
  std::string text;
  for (const Series& one : series) text += (text.empty() ? "" : ", ") + one.uid;
  return text;
}

// Stored integers are finite, but slope and intercept may take them beyond what a float holds.
Status require_finite_range(const Volume& volume, const std::string& source) {
  if (volume.geometry.voxel_count() <= 0) return fail(ErrorKind::input, "{}: has no voxels", source);
  const bool are_ends_finite = with_type(volume, [](const auto& typed) {
    using Limits = std::numeric_limits<typename std::decay_t<decltype(typed.stored)>::value_type>;
    return std::isfinite(typed.rescaled(Limits::lowest())) && std::isfinite(typed.rescaled(Limits::max()));
  });
  if (are_ends_finite) return {};  // and with them all between
  const auto [low, high] = volume.range();
  if (std::isfinite(low) && std::isfinite(high)) return {};
  return fail(ErrorKind::input, "{}: slope {} and intercept {} lead to values that are not finite", source,
              volume.slope, volume.intercept);
}

Result<Volume> load_chosen(const Series& series, const Progress& progress) {
  auto volume = is_volume_file(series) ? read_volume_file(series.files.front(), progress)
                                       : load_dicom(series, progress);
  if (!volume) {
    if (series.archive) volume.error().message = series.archive->name_archive_in(volume.error().message);
    return volume;
  }
  if (is_volume_file(series)) return volume;  // which has neither slope nor intercept, and was checked
  const std::string source = series.files.front().parent_path().string();
  TIDEMARK_TRY(require_finite(*volume, source));
  TIDEMARK_TRY(require_finite_range(*volume, source));
  return volume;
}

bool is_plain_volume_file(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored) && is_readable_volume_file(path) && !is_picture_file(path);
}

// The header is read once: of a small volume that is much of the time.
Result<LoadedSeries> load_volume_file(const fs::path& file, const Progress& progress) {
  return guarded(file, [&]() -> Result<LoadedSeries> {
    auto read = read_volume_with_series(file, progress);
    if (!read) return pass_on(read);
    return LoadedSeries{std::move(read->series), std::move(read->volume)};
  });
}

// The grid of one slice of a grid.
Geometry geometry_of_slice(Geometry geometry, std::int64_t k) {
  geometry.origin_mm = geometry.to_patient({0.0, 0.0, static_cast<double>(k)});
  geometry.size.z = 1;
  return geometry;
}

Volume cut_slice(const Volume& whole, std::int64_t k) {
  Volume slice;
  slice.geometry = geometry_of_slice(whole.geometry, k);
  slice.slope = whole.slope;
  slice.intercept = whole.intercept;
  slice.modality = whole.modality;
  slice.unit = whole.unit;
  slice.description = whole.description;
  slice.window = whole.window;
  std::visit(
      [&](const auto& voxels) {
        const auto begin = voxels.begin() + whole.geometry.offset({0, 0, k});
        slice.voxels = std::decay_t<decltype(voxels)>(begin, begin + slice.geometry.voxel_count());
      },
      whole.voxels);
  return slice;
}

Result<Volume> load_slice_of(const Series& series, std::int64_t k, const Progress& progress) {
  if (k < 0 || k >= series.geometry.size.z) {
    return fail(ErrorKind::usage, "{}: has no slice {}", series.description, k);
  }
  if (is_volume_file(series)) {
    auto whole = load_chosen(series, progress);
    if (!whole) return whole;
    return cut_slice(*whole, k);
  }
  Series one = series;
  if (series.grid.slices.empty()) {
    one.sources = {series.sources.at(static_cast<std::size_t>(k))};
    one.files = {one.sources.front().file};
  } else {
    one.grid.slices = {series.grid.slices.at(static_cast<std::size_t>(k))};
  }
  one.geometry = geometry_of_slice(series.geometry, k);
  return load_chosen(one, progress);
}

// By its own UID, by that of the series whose part it is, or by none.
bool is_asked_for(const Series& series, const std::string& uid) {
  return uid.empty() || series.uid == uid || series.uid.starts_with(uid + '#');
}

// A scout, a capture of the screen, a picture, or what cannot be loaded at all.
bool is_single_image(const Series& series) {
  return series.sources.size() <= 1 && series.geometry.size.z <= 1;
}

// The check on a series from outside.
Status require_loadable(const Series& series) {
  if (series.loadable && !series.files.empty()) return {};
  return fail(ErrorKind::input, "{}: cannot be loaded: {}", series.description, series.reason);
}

Mask mask_of(const Volume& volume) {
  Mask mask;
  mask.geometry = volume.geometry;
  with_type(volume, [&](const auto& typed) {
    mask.voxels.resize(typed.stored.size());
    std::transform(typed.stored.begin(), typed.stored.end(), mask.voxels.begin(),
                   [&](auto voxel) { return static_cast<std::uint8_t>(typed.rescaled(voxel) != 0.0F); });
  });
  return mask;
}

}  // namespace

Series by_policy(Series series, const GridPolicy& policy) {
  set_grid(series, policy);
  return series;
}

std::vector<const Series*> meant_series(const Catalogue& catalogue, const std::string& uid) {
  std::vector<const Series*> meant;
  for (const Series& series : catalogue.series) {
    if (is_asked_for(series, uid)) meant.push_back(&series);
  }
  const auto is_single = [](const Series* one) { return is_single_image(*one); };
  const bool has_several = !std::all_of(meant.begin(), meant.end(), is_single);
  if (uid.empty() && has_several) std::erase_if(meant, is_single);
  return meant;
}

std::string reason_under(const fs::path& path, const Series& series) {
  return path.string() + ": " + without_path(without_path(series.reason, path), path.filename());
}

const Series* find_fillable(const Catalogue& catalogue, const std::string& uid) {
  const Series* fillable = nullptr;
  for (const Series* series : meant_series(catalogue, uid)) {
    if (series->loadable) return nullptr;
    if (fillable == nullptr && series->fillable()) fillable = series;
  }
  return fillable;
}

Result<Catalogue> find_series(const fs::path& path, const Progress& progress, const GridPolicy& policy) {
  return guarded(path, [&]() -> Result<Catalogue> {
    std::error_code error;
    if (!fs::exists(path, error)) return fail(ErrorKind::input, "{}: no such file or folder", path.string());
    if (!fs::is_directory(path, error) && !fs::is_regular_file(path, error)) {
      return fail(ErrorKind::input, "{}: is neither a file nor a folder", path.string());
    }
    auto catalogue =
        fs::is_directory(path, error) ? find_in_folder(path, progress) : find_in_file(path, progress);
    if (catalogue && catalogue->series.empty()) {
      return fail(ErrorKind::input, "{}: holds no DICOM series, volume file or picture", path.string());
    }
    if (catalogue && policy != GridPolicy()) {
      for (Series& series : catalogue->series) set_grid(series, policy);
    }
    return catalogue;
  });
}

Result<ChosenSeries> choose_series(const Catalogue& catalogue, const std::string& uid, const fs::path& path) {
  const std::vector<const Series*> matching = meant_series(catalogue, uid);
  if (matching.empty()) {
    return fail(ErrorKind::input, "{}: has no series {}; it has {}", path.string(), uid,
                list_uids(catalogue.series));
  }
  std::vector<const Series*> loadable;
  std::copy_if(matching.begin(), matching.end(), std::back_inserter(loadable),
               [](const Series* series) { return series->loadable; });
  if (loadable.empty()) {
    const std::string others =
        matching.size() == 1 ? "" : fmt::format(" (and {} more series)", matching.size() - 1);
    return fail(ErrorKind::input, "{}{}", reason_under(path, *matching.front()), others);
  }
  const Series* best = *std::max_element(
      loadable.begin(), loadable.end(),
      [](const Series* a, const Series* b) { return a->geometry.voxel_count() < b->geometry.voxel_count(); });
  ChosenSeries chosen{*best, {}};
  if (loadable.size() > 1) {
    // Asked for by its UID and found by it: copies of one series in several folders.
    const bool are_copies = best->uid == uid;
    chosen.remarks.push_back(
        are_copies
            ? fmt::format("{} series have this UID; the one in {} was read", loadable.size(),
                          best->files.front().parent_path().filename().string())
            : fmt::format("{} {} can be loaded; {} ({}) has the most voxels and was read", loadable.size(),
                          uid.empty() ? "series" : "volumes of this series", best->uid, best->description));
  }
  return chosen;
}

Result<Volume> load_volume(const fs::path& path, const std::string& uid, const Progress& progress,
                           const GridPolicy& policy) {
  auto study = load_with_series(path, uid, progress, policy);
  if (!study) return pass_on(study);
  return std::move(study->volume);
}

Result<LoadedSeries> load_with_series(const fs::path& path, const std::string& uid, const Progress& progress,
                                      const GridPolicy& policy) {
  if (uid.empty() && is_plain_volume_file(path)) return load_volume_file(path, progress);
  const auto catalogue = find_series(path, progress, policy);
  if (!catalogue) return tl::unexpected(catalogue.error());
  auto chosen = choose_series(*catalogue, uid, path);
  if (!chosen) return pass_on(chosen);
  auto volume = load_series(*chosen, progress);
  if (!volume) return pass_on(volume);
  return LoadedSeries{std::move(chosen->series), std::move(*volume)};
}

std::vector<fs::path> dicom_files_of(const Series& series) {
  return is_volume_file(series) ? std::vector<fs::path>() : series.files;
}

AuditedStudy audited_study(const Series& series) {
  if (is_volume_file(series)) return {};
  AuditedStudy study{series.patient.id, series.patient.name, series.study_uid, {}};
  if (!series.sop_class_uid.empty())
    study.objects[series.sop_class_uid] = static_cast<std::int64_t>(series.files.size());
  return study;
}

Result<Volume> load_series(const Series& series, const Progress& progress) {
  TIDEMARK_TRY(require_loadable(series));
  auto volume = guarded(series.files.front(), [&] { return load_chosen(series, progress); });
  if (AuditedStudy study = audited_study(series); study.is_known()) {
    const std::string failure = volume ? std::string() : volume.error().message;
    record_audit({.kind = AuditEvent::Kind::accessed, .study = std::move(study), .failure = failure});
  }
  return volume;
}

Result<Volume> load_series(const ChosenSeries& chosen, const Progress& progress) {
  auto volume = load_series(chosen.series, progress);
  if (!volume) return volume;
  volume->changes.insert(volume->changes.begin(), chosen.remarks.begin(), chosen.remarks.end());
  return volume;
}

Result<Volume> load_slice(const Series& series, std::int64_t k, const Progress& progress) {
  TIDEMARK_TRY(require_loadable(series));
  return guarded(series.files.front(), [&] { return load_slice_of(series, k, progress); });
}

Result<Mask> load_mask(const fs::path& path, const Progress& progress) {
  return guarded(path, [&]() -> Result<Mask> {
    const auto study = load_with_series(path, {}, progress);
    if (!study) return tl::unexpected(study.error());
    return mask_of(study->volume);
  });
}

}  // namespace tidemark::imaging
