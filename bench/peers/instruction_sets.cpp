#include <fmt/format.h>

#include <cstdlib>

#include "bench/peers/measurements.h"

namespace tidemark::bench {

Status measure_instruction_sets(const Problem& problem, Report& report) {
  const char* before = std::getenv("TIDEMARK_SIMD");
  const std::string chosen = before != nullptr ? before : "";
  std::vector<std::pair<std::string, Mask>> results;
  std::vector<std::vector<Cell>> rows;
  Status status;
  for (const char* name : {"sse4", "avx2", "avx512"}) {
    setenv("TIDEMARK_SIMD", name, 1);
    auto run = tidemark_host(true).converge(problem);
    if (!run && run.error().kind == ErrorKind::capability) {
      rows.push_back({text(name), text("this processor lacks it"), none()});
      continue;
    }
    if (!run) {
      status = pass_on(run);
      break;
    }
    results.emplace_back(name, std::move(run->result));
    rows.push_back({text(name), number(static_cast<double>(run->steps)), number(run->seconds, 4)});
  }
  if (chosen.empty()) {
    unsetenv("TIDEMARK_SIMD");
  } else {
    setenv("TIDEMARK_SIMD", chosen.c_str(), 1);
  }
  if (!status) return status;
  report.table(problem.name + ": instruction sets, to convergence", {"TIDEMARK_SIMD", "steps", "seconds"},
               rows);
  for (std::size_t i = 1; i < results.size(); ++i) {
    report.at_least(fmt::format("{}: Dice of {} with {}", problem.name, results[i].first, results[0].first),
                    dice(results[i].second, results[0].second), 0.999, 5);
  }
  return {};
}

}  // namespace tidemark::bench
