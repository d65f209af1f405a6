// The cases of a cohort in the order in which a person looks at them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/progress.h"
#include "document/cohort/case_status.h"
#include "document/cohort/cohort_folder.h"
#include "document/cohort/decisions.h"

namespace tidemark::cohort {

struct ReviewEntry {
  WorkRow row;
  std::optional<CaseStatus> status;  // unset: the case is not computed
  double unusual = 0.0;              // see ReviewedCase; 0: not known
  Decision decision;
};

struct ReviewList {
  CohortPlan plan;
  std::vector<ReviewEntry> entries;     // the most unusual first; behind them those that are not computed
  std::vector<std::string> unreadable;  // as in Review
};

// Fails (ErrorKind::input) where the folder holds no cohort, or its work list is damaged;
// (ErrorKind::cancelled).
Result<ReviewList> load_review_list(const CohortFolder& folder, const Progress& progress = {});

}  // namespace tidemark::cohort
