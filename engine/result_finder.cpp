#include "engine/result_finder.h"

#include <algorithm>

#include "engine/study_loader.h"
#include "imaging/dicom/dicom.h"
#include "imaging/results/results.h"

namespace tidemark {
namespace {

namespace fs = std::filesystem;

std::optional<ResultForm> form_of(const fs::path& file) {
  return looks_like_dicom(file) ? result_form_of(file) : std::nullopt;
}

bool lies_below(const fs::path& file, const fs::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), file.begin(), file.end()).first == folder.end();
}

// Whether the series has results for files; its first one shows it.
bool holds_results(const Series& series) {
  return !series.loadable && !series.files.empty() && form_of(series.files.front());
}

Result<std::vector<FoundResult>> find_results(const Series& series, const Catalogue& found_with,
                                              const Progress& progress) {
  const fs::path around = series.archive ? fs::path() : StudyLoader::place_of(series).parent_path();
  std::vector<FoundResult> results;
  const auto look_at = [&](const fs::path& file) {
    if (progress.cancelled() || !lies_below(file, around)) return;
    if (const auto form = form_of(file)) results.push_back({file, *form});
  };
  for (const Series& one : found_with.series) {
    if (!holds_results(one)) continue;
    for (const fs::path& file : one.files) look_at(file);
  }
  for (const SkippedFile& skipped : found_with.skipped) look_at(skipped.file);
  std::sort(results.begin(), results.end(),
            [](const FoundResult& a, const FoundResult& b) { return a.file < b.file; });
  if (progress.cancelled()) return cancelled_error();
  return results;
}

}  // namespace

ResultFinder::ResultFinder(QObject* parent) : JobRunner("tidemark::LoadingStep", parent) {}

void ResultFinder::look(const Series& series, std::shared_ptr<const Catalogue> found_with) {
  run([series, found_with = std::move(found_with)](
          const Progress& progress) { return find_results(series, *found_with, progress); },
      [this](const std::vector<FoundResult>& results) { emit found(results); });
}

}  // namespace tidemark
