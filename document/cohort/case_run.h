// The computation of one case: from its row to its files.
#pragma once

#include <filesystem>
#include <string>

#include "core/progress.h"
#include "document/cohort/case_status.h"
#include "document/cohort/cohort_folder.h"
#include "imaging/pacs/configuration.h"

namespace tidemark::cohort {

struct CaseRun {
  const CohortPlan& plan;
  int threads = 1;
  std::int64_t memory_bytes = 0;            // that the solver may take; 0: as it sees fit
  std::string program;                      // version
  imaging::PacsConfiguration servers = {};  // that cases are on
  // Where the folder of a case is once it is complete, by its id, as the audit log names it; empty: where it
  // is written.
  std::filesystem::path cases = {};
};

// Computes a case by the host executor, as `segment --executor host` does, to the last bit, and writes all
// but the status into the folder. What goes wrong with the case is in the status. Fails where it is no case's
// fault: a file cannot be written (ErrorKind::write), the server that has the study is not known, answers
// nobody or cannot send to this machine (ErrorKind::input); and with ErrorKind::cancelled.
Result<CaseStatus> run_case(const CaseRun& run, const WorkRow& row, const std::filesystem::path& folder,
                            const Progress& progress = {});

// Computes a tiny case and forgets it. Libraries then have found their functions and made their tables, which
// processes that are forked from this one inherit: of a small case that is most of the time. Starts no
// thread.
void warm_up(const CaseRun& run);

}  // namespace tidemark::cohort
