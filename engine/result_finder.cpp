#include "engine/result_finder.h"

#include <algorithm>

#include "engine/study_loader.h"
#include "imaging/dicom/dicom.h"
#include "imaging/results/results.h"

namespace tidemark::engine {
namespace {

namespace fs = std::filesystem;

std::optional<imaging::ResultForm> form_of(const fs::path& file) {
  return imaging::looks_like_dicom(file) ? imaging::result_form_of(file) : std::nullopt;
}

bool lies_below(const fs::path& file, const fs::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), file.begin(), file.end()).first == folder.end();
}

// Whether the series has results for files; its first one shows it.
bool holds_results(const imaging::Series& series) {
  return !series.loadable && !series.files.empty() && form_of(series.files.front());
}

// The places and the study of which results belong to a series.
class Surroundings {
 public:
  explicit Surroundings(const imaging::Series& series)
      : series_(series), around_(StudyLoader::place_of(series).parent_path()) {}

  // Whether the file lies around the series or is of its study, which may be spread over folders.
  bool hold(const fs::path& file) {
    if (series_.archive || lies_below(file, around_)) return true;
    if (series_.transfer_syntaxes.empty()) return false;  // a volume file
    if (!study_uid_) study_uid_ = imaging::study_uid_of(series_.files.front());
    return !study_uid_->empty() && imaging::study_uid_of(file) == *study_uid_;
  }

 private:
  const imaging::Series& series_;
  fs::path around_;
  std::optional<std::string> study_uid_;  // when it was needed
};

Result<std::vector<FoundResult>> find_results(const imaging::Series& series,
                                              const imaging::Catalogue& found_with,
                                              const Progress& progress) {
  Surroundings surroundings(series);
  std::vector<FoundResult> results;
  const auto look_at = [&](const fs::path& file) {
    if (progress.cancelled()) return;
    if (const auto form = form_of(file); form && surroundings.hold(file)) results.push_back({file, *form});
  };
  for (const imaging::Series& one : found_with.series) {
    if (!holds_results(one)) continue;
    for (const fs::path& file : one.files) look_at(file);
  }
  for (const imaging::SkippedFile& skipped : found_with.skipped) {
    look_at(skipped.unpacked.empty() ? skipped.file : skipped.unpacked);
  }
  std::sort(results.begin(), results.end(),
            [](const FoundResult& a, const FoundResult& b) { return a.file < b.file; });
  if (progress.cancelled()) return cancelled_error();
  return results;
}

}  // namespace

ResultFinder::ResultFinder(QObject* parent) : JobRunner(parent) {}

void ResultFinder::look(const imaging::Series& series, std::shared_ptr<const imaging::Catalogue> found_with) {
  run([series, found_with = std::move(found_with)](
          const Progress& progress) { return find_results(series, *found_with, progress); },
      [this](const std::vector<FoundResult>& results) { emit found(results); });
}

}  // namespace tidemark::engine
