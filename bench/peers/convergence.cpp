#include <fmt/format.h>

#include <map>

#include "bench/peers/measurements.h"

namespace tidemark::bench {
namespace {

struct Entry {
  ContestantKind kind;
  std::vector<double> seconds;
  Convergence last;
};

// The cost of a step once the surface has stopped and its pages are quiet, in % of a step of the same
// surface that computes every page.
Result<double> converged_step_percent(const Problem& problem, int rounds) {
  auto quiet = tidemark_host(true).make(problem);
  if (!quiet) return pass_on(quiet);
  auto active = tidemark_host(false).make(problem);
  if (!active) return pass_on(active);
  constexpr std::int64_t kUntilQuiet = 2000;
  TIDEMARK_TRY((*quiet)->advance(kUntilQuiet));
  TIDEMARK_TRY((*active)->advance(kUntilQuiet / 4));
  std::vector<double> percents;
  for (int round = 0; round < rounds; ++round) {
    auto cheap = (*quiet)->advance(2000);
    if (!cheap) return pass_on(cheap);
    auto full = (*active)->advance(200);
    if (!full) return pass_on(full);
    percents.push_back(100.0 * (cheap->seconds / static_cast<double>(cheap->steps)) /
                       (full->seconds / static_cast<double>(full->steps)));
  }
  return median(std::move(percents));
}

void add_goals(const Problem& problem, const std::map<std::string, const Entry*>& entries, Report& report) {
  const auto ours = entries.find("host");
  const auto itk = entries.find("itk-threshold");
  const auto parallel = entries.find("itk-parallel");
  if (ours == entries.end() || itk == entries.end()) return;
  const auto add_ratios = [&](const char* who, const Entry& entry, double to_one, double to_parallel) {
    const double seconds = median(entry.seconds);
    report.at_least(fmt::format("{}: {} against itk-threshold, time to convergence", problem.name, who),
                    median(itk->second->seconds) / seconds, to_one);
    if (parallel == entries.end()) return;
    report.at_least(fmt::format("{}: {} against itk-parallel, time to convergence", problem.name, who),
                    median(parallel->second->seconds) / seconds, to_parallel);
  };
  add_ratios("host", *ours->second, 20, 12);
  if (const auto levels = entries.find("host-levels"); levels != entries.end() && problem.seed) {
    add_ratios("host coarse to fine", *levels->second, 60, 40);
    report.at_least(problem.name + ": Dice of host coarse to fine with host",
                    dice(levels->second->last.result, ours->second->last.result), 0.995, 4);
  }
  report.at_least(problem.name + ": Dice of host with itk-threshold",
                  dice(ours->second->last.result, itk->second->last.result), 0.98, 4);
}

}  // namespace

Status measure_convergence(const Problem& problem, const Settings& settings, Report& report) {
  std::vector<Entry> entries;
  for (ContestantKind& kind : all_contestants()) {
    if (kind.converge && wanted(settings, kind.name)) entries.push_back({std::move(kind), {}, {}});
  }
  if (wanted(settings, "host")) entries.push_back({tidemark_levels(), {}, {}});
  for (int round = 0; round < settings.rounds; ++round) {
    for (Entry& entry : entries) {
      auto run = entry.kind.converge(problem);
      if (!run) return pass_on(run);
      entry.seconds.push_back(run->seconds);
      entry.last = std::move(*run);
    }
  }
  std::map<std::string, const Entry*> by_name;
  for (const Entry& entry : entries) by_name[entry.kind.name] = &entry;
  const auto itk = by_name.find("itk-threshold");
  std::vector<std::vector<Cell>> rows;
  for (const Entry& entry : entries) {
    rows.push_back(
        {text(entry.kind.description),
         number(static_cast<double>(entry.last.steps)),
         {entry.last.converged ? "yes" : "no", entry.last.converged},
         number(median(entry.seconds), 4),
         itk == by_name.end() ? none() : number(dice(entry.last.result, itk->second->last.result), 4),
         number(dice(entry.last.result, problem.truth), 4)});
  }
  report.table(fmt::format("{}: from source to mask at convergence", problem.name),
               {"contestant", "steps", "converged", "seconds", "Dice with ITK", "Dice with truth"}, rows);
  add_goals(problem, by_name, report);
  if (wanted(settings, "host")) {
    const auto percent = converged_step_percent(problem, settings.rounds);
    if (!percent) return pass_on(percent);
    report.at_most(problem.name + ": a converged step in % of an active one", *percent, 2, 2);
  }
  return {};
}

}  // namespace tidemark::bench
