// The review of a cohort: its cases with the most unusual first, as tables.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/progress.h"
#include "document/cohort/case_status.h"
#include "document/cohort/cohort_folder.h"
#include "document/cohort/decisions.h"

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

// A |z| that a person should look at, as Iglewicz and Hoaglin advise.
inline constexpr double kFarOff = 3.5;

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
  double unusual = 0.0;  // the largest |z|
};

struct Review {
  // Those without a result, those without a surface (it has vanished, or fills the volume), then the rest; of
  // each the most unusual first.
  std::vector<ReviewedCase> cases;
  std::vector<std::string> not_done;    // ids
  RobustScale scales[kReviewFigures];   // of cases with a surface
  std::vector<Decision> decisions;      // as the folder keeps them; of cases that are not in the list, too
  std::vector<std::string> unreadable;  // statuses, and the table of decisions; one sentence each

  [[nodiscard]] std::int64_t count(CaseOutcome outcome) const;
};

// Reads the status of each row, and what people have said. What cannot be read is no reason to lose the rest.
// Fails with ErrorKind::cancelled.
Result<Review> review(const CohortFolder& folder, const WorkList& list, const Progress& progress = {});

// A line a case, with each of its figures and its z. Text from outside is no formula of a spreadsheet.
[[nodiscard]] std::string review_csv(const Review& review);
[[nodiscard]] std::string review_json(const Review& review);

}  // namespace tidemark::cohort
