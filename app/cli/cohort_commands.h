// The commands of the group `cohort`.
#pragma once

#include <cstdint>

#include "app/cli/program.h"

namespace tidemark::cli {

inline constexpr std::int64_t kMostMegabytes = std::int64_t{1} << 40;  // of --memory

void add_cohort_plan(CLI::App& cohort, Program& program);
void add_cohort_run(CLI::App& cohort, Program& program);
void add_cohort_report(CLI::App& cohort, Program& program);
void add_cohort_submit(CLI::App& cohort, Program& program);

// DIR, the folder of a cohort that was planned.
inline void add_cohort_folder(CLI::App& command, std::string& folder) {
  command.add_option("DIR", folder, "The folder of a cohort, as cohort plan has made it")
      ->required()
      ->type_name("");
}

}  // namespace tidemark::cli
