// The work list of a cohort: a row a case, as a table that people and programs can edit.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/result.h"

namespace tidemark::cohort {

// How the name of a server's studies begins: "pacs:SERVER".
inline constexpr std::string_view kPacsSource = "pacs:";

struct Seed {
  glm::dvec3 centre{0.0};  // voxel indices, or patient coordinates in mm (LPS)
  double radius_mm = 0.0;
  bool operator==(const Seed&) const = default;
};

// A case. What is not set comes from its recipe.
struct WorkRow {
  std::string id;                // a safe name of a folder
  std::filesystem::path input;   // a file or a folder; empty: a server has the study
  std::string server;            // a PACS, by its name in the plan's file of servers; empty: none
  std::string study;             // UID, on the server
  std::string series;            // UID; empty: the only one, or the largest
  std::filesystem::path recipe;  // of its own; empty: the cohort's
  std::filesystem::path mask;    // to start from; empty: none
  std::filesystem::path speed_map;
  std::filesystem::path truth;  // to compare with
  std::optional<std::int64_t> truth_label;
  std::vector<Seed> seeds;     // in voxels
  std::vector<Seed> seeds_mm;  // in the patient
  std::optional<std::pair<double, double>> threshold;
  bool auto_start = false;
  std::optional<double> within_mm;  // of the mask
  std::optional<double> target, range, alpha, smooth_mm;
  std::optional<std::int64_t> steps, max_steps, levels;
  std::size_t line = 0;  // of the file that it was read from

  [[nodiscard]] bool has_start() const {
    return !mask.empty() || !seeds.empty() || !seeds_mm.empty() || threshold;
  }
  // Where the study is, for people: the input, or "pacs:SERVER/STUDY".
  [[nodiscard]] std::string place() const;
  // What it lacks is that of `defaults`; a start as a whole.
  void complete(const WorkRow& defaults);
  // What is given takes the place of its own; a start as a whole, and the steps. A start on the voxels of its
  // study stays where auto_start alone is given, which is for rows without a start.
  void replace(const WorkRow& given);
  bool operator==(const WorkRow&) const = default;
};

inline constexpr std::size_t kMostCases = 1'000'000;

// Letters, digits, '.', '_' and '-', not in front; at most 100 of them.
[[nodiscard]] bool is_safe_id(std::string_view id);
// The text with all else replaced; never empty.
[[nodiscard]] std::string safe_id(std::string_view text);

struct WorkList {
  std::vector<WorkRow> rows;
  std::vector<std::string> problems;  // each names file, line and column

  // A table whose first line names its columns, of which `input` or `server` is needed. Relative paths are
  // below `folder`. A row without an id has the name of its input, or the series' UID. Fails
  // (ErrorKind::input) where it is no table, or a column has no meaning. What is wrong in rows is a problem
  // each.
  static Result<WorkList> parse(std::string_view text, const std::string& file,
                                const std::filesystem::path& folder);
  static Result<WorkList> load(const std::filesystem::path& file);
  // The columns that any row uses.
  [[nodiscard]] std::string to_text() const;
  // Adds a problem for each id that two rows have.
  void find_double_ids(const std::string& file);
};

// What is wrong with the values of a row, whatever its study is, one sentence each that begins with columns.
[[nodiscard]] std::vector<std::string> problems_of_values(const WorkRow& row);

// What is wrong with the row alone, one sentence each that begins with a column; no file is looked at.
[[nodiscard]] std::vector<std::string> problems_of(const WorkRow& row);

}  // namespace tidemark::cohort
