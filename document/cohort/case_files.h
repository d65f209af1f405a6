// The files of a case of a cohort, beside its status.
#pragma once

#include <filesystem>
#include <vector>

#include "core/progress.h"
#include "document/cohort/case_status.h"
#include "document/cohort/cohort_folder.h"
#include "document/recipe.h"
#include "solver/field.h"
#include "solver/statistics.h"

namespace tidemark::cohort {

// A surface in a case's volume, by a run or by a person.
struct CaseResult {
  const Volume& source;  // as the solver saw it
  const solver::Field& phi;
  const solver::SurfaceStatistics& surface;  // of phi
  const document::Recipe& recipe;
  std::vector<std::filesystem::path> dicom_files;  // that DICOM results refer to; empty: not DICOM
  int threads = 1;                                 // for the picture
};

// Measures the rest of the result and writes mask, recipe, picture and what else the plan wants into the
// folder. Figures that say how it was computed, and warnings of that, are the caller's. Fails as load_truth()
// does, or (ErrorKind::write).
Status write_case_files(const CohortPlan& plan, const WorkRow& row, const CaseResult& result,
                        const std::filesystem::path& folder, CaseStatus& status,
                        const Progress& progress = {});

}  // namespace tidemark::cohort
