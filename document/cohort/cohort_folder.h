// The folder of a cohort: its plan, its work list, and a folder for each case that is done.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "document/cohort/shared_recipe.h"
#include "document/cohort/work_list.h"

namespace tidemark::cohort {

// What is written of each case beside its mask, status, recipe and picture.
enum class CaseOutput { segmentation, structure_set, surface, level_set };
[[nodiscard]] const std::vector<std::string_view>& output_names();  // in the same order

// All that a run needs to know beside the rows.
struct CohortPlan {
  std::string recipe_checksum;              // of recipe.json; empty: each row has all that it needs
  std::optional<SharedRecipe> recipe = {};  // of it
  std::vector<CaseOutput> outputs;
  bool pictures = true;
  std::string source;                       // that was planned: a folder, BIDS, a list, "pacs:SERVER"
  std::string program, planned;             // version; UTC
  std::filesystem::path servers_file = {};  // of the servers that cases are on; empty: the usual one
};

// Paths alone; nothing need be there.
//   work.csv plan.json recipe.json recipes/   the plan
//   cases/ID/                                 a case that is done, whatever its outcome
//   cases/ID/automatic/                       what a run had made of it, where a person has corrected it
//   decisions.csv                             what people have said of cases
//   leases/ staging/                          the work of runs that compute
class CohortFolder {
 public:
  explicit CohortFolder(std::filesystem::path folder) : folder_(std::move(folder)) {}

  [[nodiscard]] const std::filesystem::path& path() const { return folder_; }
  [[nodiscard]] std::filesystem::path work_list() const { return folder_ / "work.csv"; }
  [[nodiscard]] std::filesystem::path plan() const { return folder_ / "plan.json"; }
  [[nodiscard]] std::filesystem::path recipe() const { return folder_ / "recipe.json"; }
  [[nodiscard]] std::filesystem::path recipes() const { return folder_ / "recipes"; }
  [[nodiscard]] std::filesystem::path leases() const { return folder_ / "leases"; }
  [[nodiscard]] std::filesystem::path staging() const { return folder_ / "staging"; }
  [[nodiscard]] std::filesystem::path cases() const { return folder_ / "cases"; }
  [[nodiscard]] std::filesystem::path case_folder(const std::string& id) const { return cases() / id; }
  [[nodiscard]] std::filesystem::path status(const std::string& id) const {
    return case_folder(id) / "status.json";
  }
  [[nodiscard]] std::filesystem::path automatic(const std::string& id) const {
    return case_folder(id) / "automatic";
  }
  [[nodiscard]] std::filesystem::path picture(const std::string& id) const {
    return case_folder(id) / "overview.png";
  }
  [[nodiscard]] std::filesystem::path case_recipe(const std::string& id) const {
    return case_folder(id) / "recipe.json";
  }
  [[nodiscard]] std::filesystem::path decisions() const { return folder_ / "decisions.csv"; }
  [[nodiscard]] bool is_planned() const;
  // Whether a plan would replace nothing. Fails (ErrorKind::usage) where there is one already, or a work list
  // or a recipe of somebody else.
  [[nodiscard]] Status check_free() const;

  // The names in cases/. Fails (ErrorKind::input).
  [[nodiscard]] Result<std::vector<std::string>> finished_ids() const;

  // Fails (ErrorKind::input) naming the file: it is missing, or holds what no plan does.
  [[nodiscard]] Result<CohortPlan> load_plan() const;
  // The rows, all in order. Fails likewise, with the first problem.
  [[nodiscard]] Result<WorkList> load_work_list() const;
  // Makes the folders and writes the plan, its recipe and its work list, or none of these files; plan.json is
  // the last. Fails as check_free() does, and with ErrorKind::write.
  Status write_plan(const CohortPlan& plan, const WorkList& list, const std::string& recipe_text) const;

 private:
  std::filesystem::path folder_;
};

}  // namespace tidemark::cohort
