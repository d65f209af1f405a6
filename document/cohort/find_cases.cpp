#include "document/cohort/find_cases.h"

#include <fnmatch.h>

#include <algorithm>
#include <atomic>
#include <map>
#include <set>
#include <system_error>
#include <unordered_map>

#include "core/text_file.h"
#include "core/thread_pool.h"
#include "document/cohort/cohort_folder.h"
#include "imaging/archive/study_archive.h"
#include "imaging/dicom/dicom.h"
#include "imaging/files/volume_file.h"
#include "imaging/guard/guarded.h"
#include "imaging/load_study.h"

namespace tidemark::cohort {
namespace {

namespace fs = std::filesystem;

bool is_there(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(path, ignored);
}

bool has_suffix(const fs::path& file, std::string_view suffix) {
  return file.filename().string().ends_with(suffix);
}

// "brain" of "a/brain.nii.gz".
std::string stem_of(const fs::path& file) {
  fs::path name = file.filename();
  if (name.extension() == ".gz") name.replace_extension();
  return name.replace_extension().string();
}

bool matches(const std::string& pattern, const fs::path& path, const fs::path& root) {
  if (pattern.empty()) return true;
  return ::fnmatch(pattern.c_str(), path.filename().c_str(), 0) == 0 ||
         ::fnmatch(pattern.c_str(), path.lexically_relative(root).c_str(), 0) == 0;
}

// The file beside an input that a pattern names; empty: there is none.
fs::path file_beside(const std::string& pattern, const fs::path& input) {
  if (pattern.empty()) return {};
  std::error_code ignored;
  const bool is_folder = fs::is_directory(input, ignored);
  std::string name = pattern;
  constexpr std::string_view kName = "{name}";
  const std::string stem = is_folder ? input.filename().string() : stem_of(input);
  for (std::size_t at = name.find(kName); at != std::string::npos; at = name.find(kName, at + stem.size())) {
    name.replace(at, kName.size(), stem);
  }
  const fs::path file = ((is_folder ? input : input.parent_path()) / name).lexically_normal();
  return is_there(file) ? file : fs::path();
}

// Rows with ids of their own, and without the files that are the masks of others.
class Collector {
 public:
  Collector(fs::path root, const FindOptions& options) : root_(std::move(root)), options_(options) {}

  void add(const fs::path& input, const std::string& series, const std::string& name) {
    if (!matches(options_.match, input, root_)) return;
    WorkRow row;
    row.input = input;
    row.series = series;
    row.mask = file_beside(options_.mask, input);
    row.truth = file_beside(options_.truth, input);
    for (const fs::path& file : {row.mask, row.truth}) {
      if (!file.empty()) beside_.insert(file);
    }
    row.id = name;
    rows_.push_back(std::move(row));
  }

  WorkList take() {
    std::erase_if(rows_, [&](const WorkRow& row) { return beside_.contains(row.input); });
    std::sort(rows_.begin(), rows_.end(), [](const WorkRow& a, const WorkRow& b) {
      return std::tie(a.input, a.series) < std::tie(b.input, b.series);
    });
    std::map<std::string, int> count;
    WorkList list;
    for (WorkRow& row : rows_) {
      constexpr std::size_t kRoom = 80;  // for a number behind it
      std::string id = safe_id(row.id.size() > kRoom ? row.id.substr(row.id.size() - kRoom) : row.id);
      while (count[id]++ > 0) id += fmt::format("_{}", count[id]);
      row.id = std::move(id);
      row.line = list.rows.size() + 2;
      list.rows.push_back(std::move(row));
    }
    return list;
  }

 private:
  fs::path root_;
  const FindOptions& options_;
  std::vector<WorkRow> rows_;
  std::set<fs::path> beside_;
};

// The folder that all files of a series are below.
fs::path folder_of(const imaging::Series& series) {
  fs::path folder = series.files.front().parent_path();
  for (const fs::path& file : series.files) {
    while (folder != folder.parent_path() && file.lexically_relative(folder).string().starts_with("..")) {
      folder = folder.parent_path();
    }
  }
  return folder;
}

// Of a file that could not be read. Pictures beside studies are previews of them.
bool seems_an_image(const fs::path& file) {
  if (imaging::is_readable_volume_file(file)) return !imaging::is_picture_file(file);
  return has_suffix(file, ".dcm") || imaging::looks_like_dicom(file) || imaging::is_zip_archive(file);
}

Result<FoundCases> find_in_folder(const fs::path& folder, const FindOptions& options,
                                  const Progress& progress) {
  const auto catalogue = imaging::find_series(folder, progress);
  if (!catalogue) return pass_on(catalogue);
  FoundCases found{"folder", {}, {}, {}, {}, {}};
  Collector collector(folder, options);
  const auto leave_out = [&](const fs::path& file, const std::string& reason) {
    if (!matches(options.match, file, folder)) return;
    found.left_out.push_back(file.string() + ": " + imaging::without_path(reason, file));
  };
  // One that is damaged has no size, by which it would be meant.
  const auto is_broken_file = [](const imaging::Series& series) {
    return !series.loadable && !series.files.empty() && imaging::dicom_files_of(series).empty();
  };
  for (const imaging::Series& series : catalogue->series) {
    if (is_broken_file(series)) leave_out(series.files.front(), series.reason);
  }
  for (const imaging::Series* series : imaging::meant_series(*catalogue, {})) {
    if (is_broken_file(*series)) continue;
    if (!series->loadable || series->files.empty()) {
      found.left_out.push_back(fmt::format("{}: {}", series->description, series->reason));
      continue;
    }
    const bool is_file = imaging::dicom_files_of(*series).empty();
    const fs::path input = is_file ? series->files.front() : folder_of(*series);
    const fs::path below = input.lexically_relative(folder);
    std::string name = is_file ? (below.parent_path() / stem_of(below)).string() : below.string();
    if (name == ".") name = folder.filename().string();
    if (is_file) found.grids[input.string()] = series->geometry;
    collector.add(input, is_file ? std::string() : series->uid, name);
  }
  for (const imaging::SkippedFile& skipped : catalogue->skipped) {
    if (seems_an_image(skipped.file)) leave_out(skipped.file, skipped.reason);
  }
  found.list = collector.take();
  return found;
}

// BIDS: sub-LABEL/[ses-LABEL/]anat/*.nii.gz; what follows from the images lies in derivatives/.
Result<FoundCases> find_in_bids(const fs::path& root, const FindOptions& options, const Progress& progress) {
  FoundCases found{"bids", {}, {}, {}, {}, {}};
  Collector collector(root, options);
  const auto each = [&](const fs::path& folder, std::string_view prefix, const auto& visit) {
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
      if (entry->path().filename().string().starts_with(prefix)) visit(entry->path());
    }
    // Not all that is named so is a subject, and not each subject has all folders.
    const bool is_none = error == std::errc::no_such_file_or_directory || error == std::errc::not_a_directory;
    if (error && !is_none) found.left_out.push_back(folder.string() + ": cannot be read: " + error.message());
  };
  const auto look_in = [&](const fs::path& folder) {
    each(folder / "anat", "sub-", [&](const fs::path& file) {
      if (has_suffix(file, ".nii.gz") || has_suffix(file, ".nii")) collector.add(file, {}, stem_of(file));
    });
  };
  each(root, "sub-", [&](const fs::path& subject) {
    if (progress.cancelled()) return;
    look_in(subject);
    each(subject, "ses-", look_in);
  });
  if (progress.cancelled()) return cancelled_error();
  found.list = collector.take();
  return found;
}

Result<FoundCases> find_in_list(const fs::path& file, const char* source) {
  auto list = WorkList::load(file);
  if (!list) return pass_on(list);
  return FoundCases{source, {}, std::move(*list), {}, {}, {}};
}

Result<FoundCases> find_on_server(const std::string& name, const FindOptions& options,
                                  const Progress& progress) {
  const auto server = options.servers.server(name);
  if (!server) return pass_on(server);
  auto list = find_in_pacs(*server, options.query, options.servers.limits, progress);
  if (!list) return pass_on(list);
  return FoundCases{"pacs", {}, std::move(*list), {}, {}, {}};
}

Result<FoundCases> find_on_disk(const fs::path& path, const FindOptions& options, const Progress& progress) {
  std::error_code ignored;
  const fs::path whole = fs::absolute(path, ignored).lexically_normal();
  const fs::path root = whole.has_filename() ? whole : whole.parent_path();
  auto found = has_suffix(root, ".csv")          ? find_in_list(root, "list")
               : CohortFolder(root).is_planned() ? find_in_list(CohortFolder(root).work_list(), "cohort")
               : is_there(root / "dataset_description.json") ? find_in_bids(root, options, progress)
                                                             : find_in_folder(root, options, progress);
  if (found) found->place = whole.string();
  return found;
}

// Reads each volume's header once, whoever has it as an input.
class RowChecker {
 public:
  RowChecker(const SharedRecipe* recipe, bool without_edits, const std::map<std::string, Geometry>& grids,
             const imaging::PacsConfiguration& servers)
      : recipe_(recipe), without_edits_(without_edits), grids_(grids), servers_(servers) {}

  // Recipes of rows are read once, before any row is checked. What is left out of them is a remark each.
  void add_recipe_of(const WorkRow& row, std::vector<std::string>& remarks) {
    if (row.recipe.empty() || own_.contains(row.recipe.string()) || !is_there(row.recipe)) return;
    const auto& own = own_.emplace(row.recipe.string(), load(row.recipe)).first->second;
    if (own) remarks.insert(remarks.end(), own->remarks().begin(), own->remarks().end());
  }

  // May be called from several threads at once.
  [[nodiscard]] std::vector<std::string> check(const WorkRow& row) const {
    std::vector<std::string> problems;
    for (const auto& [name, file] :
         {std::pair("input", row.input), std::pair("recipe", row.recipe), std::pair("mask", row.mask),
          std::pair("speed_map", row.speed_map), std::pair("truth", row.truth)}) {
      if (!file.empty() && !is_there(file)) {
        problems.push_back(fmt::format("{}: {}: no such file or folder", name, file.string()));
      }
    }
    if (!row.server.empty()) {
      std::string problem = problem_with_server(row, servers_);
      if (!problem.empty()) problems.push_back(std::move(problem));
    }
    const SharedRecipe* recipe = recipe_of(row, problems);
    const auto missing = missing_in(row, recipe);
    problems.insert(problems.end(), missing.begin(), missing.end());
    if (problems.empty() && row.server.empty()) check_header(row, recipe, problems);
    return problems;
  }

 private:
  const SharedRecipe* recipe_of(const WorkRow& row, std::vector<std::string>& problems) const {
    const auto own = own_.find(row.recipe.string());
    if (own == own_.end()) return recipe_;
    if (own->second) return &*own->second;
    problems.push_back("recipe: " + own->second.error().message);
    return nullptr;
  }

  [[nodiscard]] Result<SharedRecipe> load(const fs::path& file) const {
    const auto text = read_text_file(file, document::Recipe::kLargestFile);
    if (!text) return pass_on(text);
    return SharedRecipe::parse(*text, file.string(), without_edits_);
  }

  // Of a volume file; nothing where it is DICOM, or has a problem.
  std::optional<Geometry> grid_of(const WorkRow& row, std::vector<std::string>& problems) const {
    const auto known = grids_.find(row.input.string());
    if (known != grids_.end()) return known->second;
    if (!imaging::is_readable_volume_file(row.input)) return std::nullopt;
    const auto catalogue = imaging::find_series(row.input);
    if (!catalogue) {
      problems.push_back("input: " + catalogue.error().message);
      return std::nullopt;
    }
    const auto chosen = imaging::choose_series(*catalogue, row.series, row.input);
    if (!chosen) {
      problems.push_back("input: " + chosen.error().message);
      return std::nullopt;
    }
    return chosen->series.geometry;
  }

  void check_header(const WorkRow& row, const SharedRecipe* recipe,
                    std::vector<std::string>& problems) const {
    const auto grid = grid_of(row, problems);
    if (!grid) return;
    document::Start start;
    if (recipe != nullptr && !row.has_start() && !row.auto_start) start = recipe->start();
    for (const Seed& seed : row.seeds) start.seeds.push_back({grid->to_patient(seed.centre), seed.radius_mm});
    for (const Seed& seed : row.seeds_mm) start.seeds.push_back({seed.centre, seed.radius_mm});
    if (const Status inside = document::check_spheres(start, *grid); !inside) {
      problems.push_back("seed: " + inside.error().message);
    }
  }

  const SharedRecipe* recipe_;
  bool without_edits_;
  const std::map<std::string, Geometry>& grids_;
  const imaging::PacsConfiguration& servers_;
  std::unordered_map<std::string, Result<SharedRecipe>> own_;
};

}  // namespace

Result<FoundCases> find_cases(const std::string& source, const FindOptions& options,
                              const Progress& progress) {
  const bool is_server = source.starts_with(kPacsSource);
  auto found = is_server ? find_on_server(source.substr(kPacsSource.size()), options, progress)
                         : find_on_disk(source, options, progress);
  if (!found) return found;
  if (progress.cancelled()) return cancelled_error();
  if (is_server) found->place = source;
  if (found->list.rows.empty()) return fail(ErrorKind::input, "{}: holds no case", source);
  if (found->list.rows.size() > kMostCases) {
    return fail(ErrorKind::input, "{}: more than {} cases", source, kMostCases);
  }
  return found;
}

std::vector<bool> check_cases(FoundCases& found, const std::string& file, const SharedRecipe* recipe,
                              bool without_edits, const imaging::PacsConfiguration& servers,
                              const Progress& progress) {
  WorkList& list = found.list;
  RowChecker checker(recipe, without_edits, found.grids, servers);
  for (const WorkRow& row : list.rows) checker.add_recipe_of(row, found.remarks);
  const auto count = static_cast<std::int64_t>(list.rows.size());
  std::vector<std::vector<std::string>> problems(list.rows.size());
  std::atomic<std::int64_t> checked{0};
  ThreadPool pool(reading_threads());
  pool.for_each(count, 16, [&](std::int64_t begin, std::int64_t end, int member) {
    if (progress.cancelled()) return;
    for (std::int64_t i = begin; i < end; ++i) {
      problems[static_cast<std::size_t>(i)] = checker.check(list.rows[static_cast<std::size_t>(i)]);
    }
    checked += end - begin;
    // One call at a time: the first member speaks for all.
    if (member == 0) progress(static_cast<double>(checked) / static_cast<double>(count), "checking cases");
  });
  std::vector<bool> good(list.rows.size(), true);
  for (std::size_t i = 0; i < good.size(); ++i) {
    good[i] = problems[i].empty();
    for (const std::string& problem : problems[i]) {
      list.problems.push_back(fmt::format("{}: line {}: {}", file, list.rows[i].line, problem));
    }
  }
  return good;
}

}  // namespace tidemark::cohort
