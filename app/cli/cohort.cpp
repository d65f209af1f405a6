// tidemark-cli cohort: the group of its commands.
#include "app/cli/cohort_commands.h"

namespace tidemark::cli {
namespace {

constexpr const char* kCohortSummary = "One recipe over many studies: plan, run, report, submit";
constexpr const char* kCohortFooter =
    "\nExamples:\n"
    "  tidemark-cli cohort plan archive/ --recipe liver.json --auto-start --out livers\n"
    "  tidemark-cli cohort run livers --jobs 8\n"
    "  tidemark-cli cohort report livers\n";

}  // namespace

void add_cohort(CLI::App& app, Program& program) {
  CLI::App& cohort = *app.add_subcommand("cohort", kCohortSummary);
  cohort.footer(kCohortFooter);
  cohort.require_subcommand(1);
  add_cohort_plan(cohort, program);
  add_cohort_run(cohort, program);
  add_cohort_report(cohort, program);
  add_cohort_submit(cohort, program);
}

}  // namespace tidemark::cli
