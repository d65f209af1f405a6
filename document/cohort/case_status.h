// The status of a case: one small file that says what became of it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"

namespace tidemark::cohort {

enum class CaseOutcome {
  done,           // there is a result; warnings say whether it is of use
  refused,        // an input cannot be read, or does not fit
  timed_out,      // it took longer than its limit
  out_of_memory,  // it needed more than its limit, or than there was
  failed,         // a defect: the program ended in it
};
[[nodiscard]] std::string_view name_of(CaseOutcome outcome);

// What a person looks at first.
enum class CaseWarning { vanished, filled, not_converged, touches_border };
[[nodiscard]] std::string_view name_of(CaseWarning warning);
// For people: "timed out", "touches the border".
[[nodiscard]] std::string_view words_of(CaseOutcome outcome);
[[nodiscard]] std::string_view words_of(CaseWarning warning);

struct CaseFigures {
  double volume_ml = 0.0;
  double surface_mm2 = 0.0;
  std::int64_t voxels_inside = 0;
  std::optional<double> mean_inside;  // of the values as the solver saw them
  std::optional<double> dice;         // against the truth
  std::int64_t steps = 0;
  double solver_seconds = 0.0;
  std::string solver_outcome;  // as document::name_of(Outcome) says; "corrected" where a person has done so
  std::string unit;            // of the values; empty when they have none
  bool operator==(const CaseFigures&) const = default;
};

struct CaseStatus {
  static constexpr int kVersion = 1;
  static constexpr std::size_t kLargestFile = std::size_t{1} << 20;  // bytes

  std::string id;
  CaseOutcome outcome = CaseOutcome::failed;
  std::string reason;  // of any outcome but `done`: one line
  std::int64_t attempt = 1;
  bool corrected = false;  // a person's result is in the place of the run's
  std::string input, series;
  std::string input_checksum;   // see document/checksum.h; empty: it was not read
  std::string recipe_checksum;  // of the recipe's file; empty: there was none
  std::string program;          // its version
  std::string machine;
  std::string finished;  // UTC: "2026-03-01T12:00:00Z"
  double seconds = 0.0;  // from reading to writing
  std::int64_t peak_memory_bytes = 0;
  std::optional<CaseFigures> figures;  // of `done` alone
  std::vector<CaseWarning> warnings;
  std::vector<std::string> remarks;  // for people: what reading found and changed
  std::vector<std::string> files;    // beside this one
  bool operator==(const CaseStatus&) const = default;

  // A reason and remarks that are too long to be read again are cut.
  [[nodiscard]] std::string to_text() const;
  // Fails (ErrorKind::input) naming `file` and the field.
  static Result<CaseStatus> parse(std::string_view text, const std::string& file);
  static Result<CaseStatus> load(const std::filesystem::path& file);
};

// The present time as CaseStatus::finished has it.
[[nodiscard]] std::string utc_now();

}  // namespace tidemark::cohort
