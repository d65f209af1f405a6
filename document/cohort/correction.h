// The correction of a case of a cohort: a person's result in the place of a run's.
#pragma once

#include <optional>
#include <string>

#include "core/progress.h"
#include "document/cohort/case_files.h"

namespace tidemark::cohort {

// Writes the result, as a run would, as the case's own. What the run had made, whatever its outcome, stays
// beside it (CohortFolder::automatic()), however often the case is corrected. `seen`: the status of the
// result that the person has looked at; unset: there was none. `program`: the version. Fails
// (ErrorKind::usage) where nothing is inside, further images drive the surface (a cohort keeps none), a run
// computes the case now, or its result is another one than was seen; (ErrorKind::write);
// (ErrorKind::cancelled); and as write_case_files().
Result<CaseStatus> correct_case(const CohortFolder& folder, const CohortPlan& plan, const WorkRow& row,
                                const std::optional<CaseStatus>& seen, const CaseResult& result,
                                const std::string& program, const Progress& progress = {});

}  // namespace tidemark::cohort
