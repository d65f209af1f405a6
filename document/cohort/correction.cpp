#include "document/cohort/correction.h"

#include <system_error>

#include "core/atomic_file.h"
#include "document/cohort/lease.h"

namespace tidemark::cohort {
namespace {

namespace fs = std::filesystem;

constexpr double kCaseIsStaleAfter_s = 300.0;  // as of runs

Status check(const WorkRow& row, const CaseResult& result) {
  if (result.surface.voxels_inside == 0)
    return fail(ErrorKind::usage, "{}: nothing is inside of the surface", row.id);
  bool uses_images = false;
  document::Recipe recipe = result.recipe;
  recipe.change_drives([&](document::Drive& drive) { uses_images |= !drive.images.empty(); });
  if (uses_images)
    return fail(ErrorKind::usage, "{}: is driven by further images, of which a cohort keeps none", row.id);
  return {};
}

// The present one; unset: there is none.
Result<std::optional<CaseStatus>> present_status(const CohortFolder& folder, const std::string& id) {
  std::error_code ignored;
  if (!fs::exists(folder.case_folder(id), ignored)) return std::nullopt;
  auto status = CaseStatus::load(folder.status(id));
  if (!status) return pass_on(status);
  return std::move(*status);
}

// What a run has made, if one has, into the folder that takes the case's place.
Status keep_automatic(const CohortFolder& folder, const CaseStatus& before, const fs::path& into) {
  std::error_code error;
  const fs::path kept = folder.automatic(before.id);
  if (before.corrected && !fs::exists(kept, error)) return {};  // no run has computed it
  const fs::path from = before.corrected ? kept : folder.case_folder(before.id);
  fs::copy(from, into / "automatic", fs::copy_options::recursive, error);
  if (!error) return {};
  return fail(ErrorKind::write, "{}: cannot be kept: {}", from.string(), error.message());
}

// That of the run's, with nothing in it that the correction replaces.
CaseStatus status_after(const std::optional<CaseStatus>& before, const WorkRow& row) {
  CaseStatus status = before.value_or(CaseStatus());
  status.id = row.id;
  status.input = row.place();
  status.series = row.series;
  status.outcome = CaseOutcome::done;
  status.corrected = true;
  status.reason.clear();
  status.warnings.clear();
  status.files.clear();
  status.figures.emplace().solver_outcome = "corrected";
  status.machine = this_machine();
  status.finished = utc_now();
  return status;
}

}  // namespace

Result<CaseStatus> correct_case(const CohortFolder& folder, const CohortPlan& plan, const WorkRow& row,
                                const std::optional<CaseStatus>& seen, const CaseResult& result,
                                const std::string& program, const Progress& progress) {
  TIDEMARK_TRY(check(row, result));
  auto lease = Lease::take(folder.leases(), row.id, kCaseIsStaleAfter_s);
  if (!lease) return pass_on(lease);
  if (!*lease) return fail(ErrorKind::usage, "{}: is computed by a run now", row.id);
  auto before = present_status(folder, row.id);
  if (!before) return pass_on(before);
  if (*before != seen) return fail(ErrorKind::usage, "{}: has another result now; open it again", row.id);
  auto whole = AtomicFolder::create(folder.case_folder(row.id));
  if (!whole) return pass_on(whole);
  const fs::path& place = whole->temporary_path();
  CaseStatus status = status_after(*before, row);
  status.figures->steps = result.recipe.steps;
  status.program = program;
  if (*before) {
    TIDEMARK_TRY(keep_automatic(folder, **before, place));
  }
  TIDEMARK_TRY(write_case_files(plan, row, result, place, status, progress));
  TIDEMARK_TRY(write_file(place / "status.json", status.to_text()));
  if (progress.cancelled()) return cancelled_error();
  TIDEMARK_TRY(sync_file_system(place));
  // This program may have been held up for so long that a run has taken the case.
  if (!(*lease)->held()) return fail(ErrorKind::usage, "{}: is computed by a run now", row.id);
  TIDEMARK_TRY(whole->commit());
  (*lease)->finish();
  return status;
}

}  // namespace tidemark::cohort
