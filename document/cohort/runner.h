// The run of a cohort: what is not done is computed, in processes of its own, several cases at once.
#pragma once

#include <cstdint>
#include <functional>

#include "core/progress.h"
#include "document/cohort/case_status.h"
#include "document/cohort/cohort_folder.h"

namespace tidemark::cohort {

struct RunOptions {
  int jobs = 1;                   // cases at once
  std::int64_t shard = 1;         // of `shards`: every shards-th row, from 1
  std::int64_t shards = 0;        // 0: all rows, which other runs may share
  double timeout_s = 0.0;         // of a case; 0: none
  std::int64_t memory_bytes = 0;  // of a case, see Worker; 0: no limit
  bool retry = false;             // cases again that have no result, once
  double stale_after_s = 300.0;   // see Lease
  std::string program;            // version, for the status of a case that could not write its own
};

// Writes what there is to write of a case into the folder, in another process. An error ends the whole run,
// at once or, of ErrorKind::input, when the cases beside are complete. What is wrong with the case alone is
// in the status.
using ComputeCase =
    std::function<Result<CaseStatus>(const WorkRow& row, const std::filesystem::path& folder)>;

struct RunTally {
  std::int64_t rows = 0;          // of the shard
  std::int64_t before = 0;        // that were done before
  std::int64_t elsewhere = 0;     // that other programs hold, or have done meanwhile
  std::int64_t outcomes[5] = {};  // computed now, by CaseOutcome
  [[nodiscard]] std::int64_t computed() const;
  [[nodiscard]] std::int64_t without_result() const;  // of those
};

// The cases of the shard that are finished without a result, whoever has computed them. Reads their statuses.
[[nodiscard]] std::int64_t finished_without_result(const CohortFolder& folder, const WorkList& list,
                                                   const RunOptions& options);

// A case appears in cases/ whole and synced, or not at all, and never twice. The rows of a shard are this
// run's alone: where another program holds one, it may have been killed, and is waited for. Fails with
// ErrorKind::cancelled when it is stopped: what was begun is given back. Fails with ErrorKind::write and as
// compute() does, after the cases that were complete have been kept.
Result<RunTally> run_cohort(const CohortFolder& folder, const WorkList& list, const RunOptions& options,
                            const ComputeCase& compute, const Progress& progress = {});

}  // namespace tidemark::cohort
