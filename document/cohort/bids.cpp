#include "document/cohort/bids.h"

#include <algorithm>
#include <regex>
#include <set>
#include <system_error>

#include "core/atomic_file.h"
#include "core/json/json.h"
#include "core/json/json_field.h"
#include "core/json/json_text.h"
#include "core/lies_in.h"
#include "core/text_file.h"
#include "document/cohort/work_list.h"

namespace tidemark::cohort {
namespace {

namespace fs = std::filesystem;

constexpr const char* kVersion = "1.9.0";
constexpr const char* kDescription = "dataset_description.json";
constexpr const char* kReadme = "README";
constexpr const char* kDerivative = "derivative";
constexpr const char* kMaker = "Tidemark";
constexpr std::size_t kLargestDescription = std::size_t{1} << 20;  // bytes

std::string letters_of(std::string_view text) {
  std::string letters;
  for (const char c : text) {
    const bool known = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    if (known) letters += c;
  }
  return letters.empty() ? "x" : letters;
}

// The place of a mask.
struct MaskName {
  std::string folder;  // "sub-01/ses-2/anat"
  std::string stem;    // "sub-01_ses-2_desc-tidemarkT1w_mask"
};

// The parts of "sub-01_ses-2_run-1_T1w", the last one being the suffix.
std::vector<std::string> parts_of(const std::string& id) {
  std::vector<std::string> parts;
  for (std::size_t at = 0; at <= id.size();) {
    const std::size_t end = std::min(id.find('_', at), id.size());
    parts.push_back(id.substr(at, end - at));
    at = end + 1;
  }
  return parts;
}

// By the id alone: planning has made it of the file's name.
MaskName name_of_mask(const std::string& id) {
  const std::vector<std::string> parts = parts_of(id);
  const bool is_bids =
      parts.size() > 1 && parts.front().starts_with("sub-") &&
      std::all_of(parts.begin(), parts.end() - 1, [](const std::string& part) {
        const std::size_t hyphen = part.find('-');
        return hyphen != std::string::npos && letters_of(part.substr(hyphen)) == part.substr(hyphen + 1);
      });
  if (!is_bids) {
    const std::string subject = "sub-" + letters_of(id);
    return {subject + "/anat", subject + "_desc-tidemark_mask"};
  }
  MaskName name{parts.front(), {}};
  if (parts[1].starts_with("ses-")) name.folder += "/" + parts[1];
  name.folder += "/anat";
  for (std::size_t i = 0; i + 1 < parts.size(); ++i) {
    if (!parts[i].starts_with("desc-")) name.stem += parts[i] + "_";
  }
  name.stem += "desc-tidemark" + letters_of(parts.back()) + "_mask";
  return name;
}

// Of the source of a cohort: a folder or file, or a server as planning names it.
std::string url_of(const std::string& source) {
  return source.starts_with(kPacsSource) ? source : "file://" + source;
}

Json description_of(const BidsOptions& options) {
  return {{"Name", "Tidemark masks"},
          {"BIDSVersion", kVersion},
          {"DatasetType", kDerivative},
          {"GeneratedBy", Json::array({{{"Name", kMaker}, {"Version", options.program}}})},
          {"SourceDatasets", Json::array({{{"URL", url_of(options.source)}}})},
          {"DatasetLinks", {{"raw", url_of(options.source)}}}};
}

Json sidecar_of(const CaseStatus& status, const BidsOptions& options) {
  const fs::path below = fs::path(status.input).lexically_relative(options.source);
  const bool is_raw = !below.empty() && !below.string().starts_with("..");
  Json object{{"Type", "ROI"},
              {"Sources", Json::array({is_raw ? "bids:raw:" + below.generic_string() : status.input})},
              {"SourceChecksum", status.input_checksum},
              {"RecipeChecksum", status.recipe_checksum}};
  if (status.figures) object["VolumeMl"] = status.figures->volume_ml;
  return object;
}

// Whether the dataset is one of masks of that source.
bool is_described_as_own(const fs::path& folder, const std::string& source) {
  const std::string file = (folder / kDescription).string();
  const auto text = read_text_file(file, kLargestDescription);
  if (!text) return false;
  const auto document = JsonDocument::parse(*text, file);
  if (!document) return false;
  const JsonField root = root_of(*document, file);
  const JsonField maker = root.at("GeneratedBy").at(std::size_t{0});
  const JsonField raw = root.at("SourceDatasets").at(std::size_t{0});
  return root.at("DatasetType").text() == kDerivative && maker.at("Name").text() == kMaker &&
         raw.at("URL").text() == url_of(source);
}

// Whether all that is in it may be of write_bids(). Masks of others and links are not.
bool holds_own_files_alone(const fs::path& folder) {
  static const std::regex kFolder("sub-[^/]+(/ses-[^/]+)?(/anat)?");
  static const std::regex kMask(
      "sub-[^/]+(/ses-[^/]+)?/anat/[^/]+_desc-tidemark[^/_]*_mask\\.(nii\\.gz|json)");
  std::error_code error;
  fs::recursive_directory_iterator entry(folder, error);
  for (; !error && entry != fs::recursive_directory_iterator(); entry.increment(error)) {
    const std::string name = entry->path().lexically_relative(folder).generic_string();
    const fs::file_type type = entry->symlink_status(error).type();
    const bool is_own = type == fs::file_type::directory
                            ? std::regex_match(name, kFolder)
                            : type == fs::file_type::regular &&
                                  (name == kDescription || name == kReadme || std::regex_match(name, kMask));
    if (!is_own) return false;
  }
  return !error;
}

// A second name where the disk allows it: the masks are there once.
Status place_mask(const fs::path& from, const fs::path& to) {
  std::error_code error;
  fs::create_hard_link(from, to, error);
  if (error) fs::copy_file(from, to, error);
  if (!error) return {};
  return fail(ErrorKind::write, "{}: cannot write: {}", to.string(), error.message());
}

}  // namespace

Status check_bids_folder(const CohortFolder& folder, const std::string& source, const fs::path& to) {
  if (lies_in(to, folder.path()) || lies_in(folder.path(), to)) {
    return fail(ErrorKind::usage, "{}: lies in the cohort's folder, or holds it; name another folder",
                to.string());
  }
  if (!source.starts_with(kPacsSource)) {
    // Where BIDS wants them.
    const bool is_derivative = lies_in(to, fs::path(source) / "derivatives");
    if ((lies_in(to, source) && !is_derivative) || lies_in(source, to)) {
      return fail(
          ErrorKind::usage,
          "{}: lies among the studies of {}, or holds them; name a folder outside, or in derivatives/",
          to.string(), source);
    }
  }
  std::error_code error;
  const bool is_free = !fs::exists(to, error) || (fs::is_directory(to, error) && fs::is_empty(to, error));
  if (is_free || (is_described_as_own(to, source) && holds_own_files_alone(to))) return {};
  return fail(ErrorKind::usage,
              "{}: holds something else than earlier masks of these studies; name a new folder", to.string());
}

Result<std::int64_t> write_bids(const CohortFolder& folder, const Review& review, const BidsOptions& options,
                                const fs::path& to, const Progress& progress) {
  TIDEMARK_TRY(check_bids_folder(folder, options.source, to));
  auto target = AtomicFolder::create(to);
  if (!target) return pass_on(target);
  const fs::path root = target->temporary_path();
  std::set<std::string> used;
  std::int64_t count = 0;
  {
    const SyncLater later;
    for (const ReviewedCase& one : review.cases) {
      if (progress.cancelled()) return cancelled_error();
      if (one.status.outcome != CaseOutcome::done) continue;
      MaskName name = name_of_mask(one.status.id);
      // Ids differ, but what is left of them may not.
      for (int again = 2; !used.insert(name.folder + name.stem).second; ++again) {
        const std::string subject = fmt::format("sub-{}x{}", letters_of(one.status.id), again);
        name = {subject + "/anat", subject + "_desc-tidemark_mask"};
      }
      std::error_code error;
      fs::create_directories(root / name.folder, error);
      const fs::path stem = root / name.folder / name.stem;
      TIDEMARK_TRY(place_mask(folder.case_folder(one.status.id) / "mask.nii.gz", stem.string() + ".nii.gz"));
      TIDEMARK_TRY(write_file(stem.string() + ".json", json_text(sidecar_of(one.status, options))));
      ++count;
    }
    TIDEMARK_TRY(write_file(root / kDescription, json_text(description_of(options))));
    TIDEMARK_TRY(write_file(root / kReadme, "Masks by Tidemark, a level-set surface. Research use only.\n"));
  }
  TIDEMARK_TRY(sync_file_system(root));
  TIDEMARK_TRY(target->commit());
  return count;
}

}  // namespace tidemark::cohort
