#include <fmt/format.h>

#include <cstdio>

#include "bench/peak_memory.h"
#include "bench/peers/measurements.h"

namespace tidemark::bench {
namespace {

// Steps that a contestant computes before its peak is read: a seed grows to its full size.
std::int64_t steps_of(const Problem& problem) {
  return problem.seed ? 400 : 20;
}

Result<double> peak_of(const Problem& problem, const Settings& settings, const std::string& contestant) {
  const std::string command =
      fmt::format("'{}' --memory-of {} --case {}", settings.program, contestant, problem.name);
  std::FILE* child = popen(command.c_str(), "r");
  if (child == nullptr) return fail(ErrorKind::internal, "{}: cannot be run", command);
  long long bytes = -1;
  const int fields = std::fscanf(child, "%lld", &bytes);
  const int status = pclose(child);
  if (status != 0 || fields != 1) return fail(ErrorKind::internal, "{}: status {}", command, status);
  return static_cast<double>(bytes);
}

}  // namespace

Status print_memory_of(const Problem& problem, const std::string& contestant) {
  for (const ContestantKind& kind : all_contestants()) {
    if (kind.name != contestant) continue;
    const PeakMemory memory;
    auto made = kind.make(problem);
    if (!made) return pass_on(made);
    TIDEMARK_TRY((*made)->advance(steps_of(problem)));
    fmt::print("{}\n", memory.bytes());
    return {};
  }
  return fail(ErrorKind::usage, "no contestant is called {}", contestant);
}

Status measure_memory(const Problem& problem, const Settings& settings, Report& report) {
  constexpr double kMega = 1e6;
  const auto volume_bytes = static_cast<double>(4 * problem.source->geometry.voxel_count());
  std::vector<std::vector<Cell>> rows;
  for (const ContestantKind& kind : all_contestants()) {
    if (!wanted(settings, kind.name)) continue;
    const auto peak = peak_of(problem, settings, kind.name);
    if (!peak) return pass_on(peak);
    rows.push_back({text(kind.description), number(*peak / kMega, 1), number(*peak / volume_bytes, 2)});
  }
  report.table(
      fmt::format("{}: peak memory beside the source, after {} steps", problem.name, steps_of(problem)),
      {"contestant", "MB", "dense float volumes"}, rows);

  auto ours = tidemark_host(true).make(problem);
  if (!ours) return pass_on(ours);
  TIDEMARK_TRY((*ours)->advance(steps_of(problem)));
  const solver::MemoryReport memory = (*ours)->executor()->memory();
  const Index3 shape = memory.page_shape;
  const auto resident = static_cast<double>(memory.peak_resident_pages * shape.x * shape.y * shape.z);
  const auto bytes = static_cast<double>(memory.peak_state_bytes);
  report.table(fmt::format("{}: the host executor's own account", problem.name), {"what", "value"},
               {{text("resident voxels at the peak"), number(resident)},
                {text("state, MB"), number(bytes / kMega, 1)},
                {text("state, bytes per resident voxel"), number(bytes / resident, 2)},
                {text("source kept beside the pages, MB"),
                 number(static_cast<double>(memory.source_bytes) / kMega, 1)},
                {text("resident, % of the volume"), number(400.0 * resident / volume_bytes, 1)}});
  report.at_most(problem.name + ": solver state, bytes per resident voxel", bytes / resident, 10, 2);
  if (problem.name == "cortex") {
    report.at_most("cortex: solver state in % of one dense float volume", 100.0 * bytes / volume_bytes, 90);
  }
  return {};
}

}  // namespace tidemark::bench
