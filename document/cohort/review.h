// The review of a cohort: its cases with the most unusual first, as tables.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/progress.h"
#include "document/cohort/case_status.h"
#include "document/cohort/cohort_folder.h"

namespace tidemark::cohort {

// Middle and spread of values that a few outliers do not move.
struct RobustScale {
  double median = 0.0;
  double spread = 0.0;  // as a standard deviation; 0: all values are equal

  // 0.6745 (x - median) / MAD (Iglewicz and Hoaglin, 1993). Where more than half of the values are equal the
  // MAD is 0; the mean deviation takes its place then.
  static RobustScale of(std::vector<double> values);
  [[nodiscard]] double z(double value) const { return spread > 0.0 ? (value - median) / spread : 0.0; }
};

// The figures by which cases are compared, in this order.
inline constexpr int kReviewFigures = 4;
struct ReviewFigure {
  const char* name;  // "volume_ml"
  const char* title;
  std::optional<double> (*value)(const CaseStatus& status);
};
[[nodiscard]] std::span<const ReviewFigure, kReviewFigures> review_figures();

struct ReviewedCase {
  CaseStatus status;
  std::optional<double> z[kReviewFigures];
  double unusual = 0.0;  // the largest |z|; more than any of them where there is no result
};

struct Review {
  std::vector<ReviewedCase> cases;      // the most unusual first
  std::vector<std::string> not_done;    // ids
  RobustScale scales[kReviewFigures];   // of cases with a result
  std::vector<std::string> unreadable;  // statuses, one sentence each

  [[nodiscard]] std::int64_t count(CaseOutcome outcome) const;
};

// Reads the status of each row. A status that cannot be read is no reason to lose the others. Fails with
// ErrorKind::cancelled.
Result<Review> review(const CohortFolder& folder, const WorkList& list, const Progress& progress = {});

// A line a case, with each of its figures and its z. Text from outside is no formula of a spreadsheet.
[[nodiscard]] std::string review_csv(const Review& review);
[[nodiscard]] std::string review_json(const Review& review);

// What a person said of a case.
struct Decision {
  std::string id;
  enum class Verdict { none, accepted, rejected } verdict = Verdict::none;
  std::string comment;
};
// The table that the report's page saves: id, decision (accept, reject or nothing), comment. Fails
// (ErrorKind::input) naming file, line and column.
Result<std::vector<Decision>> load_decisions(const std::filesystem::path& file);

}  // namespace tidemark::cohort
