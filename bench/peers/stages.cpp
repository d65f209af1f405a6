#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>

#include "bench/peers/measurements.h"

namespace tidemark::bench {
namespace {

constexpr std::array<const char*, 3> kStages = {"early", "middle", "late"};
constexpr std::size_t kLate = 2;

// The steps [begin, end) of an evolution of `total` steps that make up a stage: a tenth of it.
struct Window {
  std::int64_t begin;
  std::int64_t end;
};

Window window_of(std::size_t stage, std::int64_t total) {
  const std::int64_t length = std::max<std::int64_t>(total / 10, 2);
  if (stage == 0) return {0, length};
  if (stage == 1) return {(total - length) / 2, (total + length) / 2};
  return {total - length, total};
}

struct Sample {
  double steps_per_second = 0.0;
  double updates_per_second = 0.0;
  double paging_share = 0.0;
  double resident_voxels = 0.0;
};

struct Entry {
  ContestantKind kind;
  std::int64_t total = 0;
  std::array<std::vector<Sample>, 3> samples;  // a round each
};

double median_of(const std::vector<Sample>& samples, double Sample::*member) {
  std::vector<double> values;
  for (const Sample& sample : samples) values.push_back(sample.*member);
  return median(std::move(values));
}

void add(Cost& sum, const Cost& cost) {
  sum.steps += cost.steps;
  sum.seconds += cost.seconds;
  sum.voxel_updates += cost.voxel_updates;
  sum.paging_seconds += cost.paging_seconds;
}

// One round: a whole evolution. Where a window takes too little time to be measured, the evolution is
// repeated.
Status run_round(const Problem& problem, Entry& entry) {
  constexpr double kEnoughSeconds = 0.1;
  constexpr int kMostRepeats = 10;
  std::array<Cost, 3> costs;
  std::array<double, 3> resident{};
  for (int repeat = 0; repeat < kMostRepeats; ++repeat) {
    auto contestant = entry.kind.make(problem);
    if (!contestant) return pass_on(contestant);
    std::int64_t done = 0;
    for (std::size_t stage = 0; stage < kStages.size(); ++stage) {
      const Window window = window_of(stage, entry.total);
      TIDEMARK_TRY((*contestant)->advance(window.begin - done));
      auto cost = (*contestant)->advance(window.end - window.begin);
      if (!cost) return pass_on(cost);
      add(costs[stage], *cost);
      done = window.end;
      if (const solver::Executor* executor = (*contestant)->executor(); executor != nullptr) {
        const solver::MemoryReport memory = executor->memory();
        const Index3 shape = memory.page_shape;
        resident[stage] = static_cast<double>(memory.resident_pages * shape.x * shape.y * shape.z);
      }
    }
    if (costs[kLate].seconds > kEnoughSeconds) break;
  }
  for (std::size_t stage = 0; stage < kStages.size(); ++stage) {
    const Cost& cost = costs[stage];
    if (cost.steps == 0) return fail(ErrorKind::internal, "{} stopped before the end", entry.kind.name);
    entry.samples[stage].push_back({static_cast<double>(cost.steps) / cost.seconds,
                                    static_cast<double>(cost.voxel_updates) / cost.seconds,
                                    cost.paging_seconds / cost.seconds, resident[stage]});
  }
  return {};
}

// A tenth of this many steps is a stage: to convergence where something grows from a seed, by the
// contestant's own criterion; else a fixed number.
Result<std::int64_t> evolution_length(const Problem& problem, const ContestantKind& kind, bool quick) {
  if (!problem.seed) return quick ? 20 : 50;
  // Without a criterion of its own: our number of steps, whose time step it shares.
  auto run = kind.converge ? kind.converge(problem) : tidemark_host(true).converge(problem);
  if (!run) return pass_on(run);
  return run->steps;
}

void add_goals(const Problem& problem, const std::map<std::string, const Entry*>& entries, Report& report) {
  const auto late = [&](const std::string& name, double Sample::*member) {
    const auto entry = entries.find(name);
    return entry == entries.end() ? std::nan("") : median_of(entry->second->samples[kLate], member);
  };
  const bool cortex = problem.name == "cortex";
  if (!cortex && problem.name != "tumour") return;
  const auto ratio = [&](const std::string& ours, const std::string& peer, double goal) {
    const double value = late(ours, &Sample::steps_per_second) / late(peer, &Sample::steps_per_second);
    if (std::isfinite(value)) {
      report.at_least(fmt::format("{}: {} against {}, late steps/s", problem.name, ours, peer), value, goal);
    }
  };
  const bool wide = has_avx512();
  for (const char* ours : {"host", "host-all-pages"}) {
    ratio(ours, "itk-threshold", cortex ? (wide ? 180 : 100) : (wide ? 40 : 25));
    ratio(ours, "itk-parallel", cortex ? (wide ? 70 : 40) : (wide ? 15 : 10));
    if (cortex) ratio(ours, "openvdb", 25);
  }
  const double share = 100.0 * late("host-all-pages", &Sample::updates_per_second) /
                       late("dense", &Sample::updates_per_second);
  if (std::isfinite(share)) {
    report.at_least(problem.name + ": voxel updates/s in % of the dense stencil's", share, 60);
  }
  for (const char* ours : {"host", "host-all-pages"}) {
    const double paging = 100.0 * late(ours, &Sample::paging_share);
    if (std::isfinite(paging)) {
      report.at_most(fmt::format("{}: {}, late paging in % of the time", problem.name, ours), paging, 15);
    }
  }
}

void add_table(const Problem& problem, const std::vector<Entry>& entries, Report& report) {
  std::vector<std::vector<Cell>> rows;
  for (const Entry& entry : entries) {
    std::vector<Cell> row{text(entry.kind.description), number(static_cast<double>(entry.total))};
    for (const auto& samples : entry.samples) {
      const double rate = median_of(samples, &Sample::steps_per_second);
      row.push_back(number(rate, rate < 100 ? 1 : 0));
    }
    const auto& late = entry.samples[kLate];
    const double updates = median_of(late, &Sample::updates_per_second);
    row.push_back(updates > 0 ? number(updates / 1e6) : none());
    const double resident = median_of(late, &Sample::resident_voxels);
    row.push_back(resident > 0 ? number(resident) : none());
    const double rate = median_of(late, &Sample::steps_per_second);
    row.push_back(resident > 0 ? number(resident * rate / 1e6) : none());
    row.push_back(resident > 0 ? number(100.0 * median_of(late, &Sample::paging_share), 1) : none());
    rows.push_back(std::move(row));
  }
  report.table(fmt::format("{}: steps per second", problem.name),
               {"contestant", "steps", "early", "middle", "late", "M updates/s", "resident voxels",
                "M resident/s", "paging %"},
               rows);
}

}  // namespace

Status measure_stages(const Problem& problem, const Settings& settings, Report& report) {
  std::vector<Entry> entries;
  for (ContestantKind& kind : all_contestants()) {
    if (!wanted(settings, kind.name)) continue;
    auto length = evolution_length(problem, kind, settings.quick);
    if (!length) return pass_on(length);
    entries.push_back({std::move(kind), *length, {}});
  }
  for (int round = 0; round < settings.rounds; ++round) {
    for (Entry& entry : entries) {
      TIDEMARK_TRY(run_round(problem, entry));
    }
  }
  add_table(problem, entries, report);
  std::map<std::string, const Entry*> by_name;
  for (const Entry& entry : entries) by_name[entry.kind.name] = &entry;
  add_goals(problem, by_name, report);
  return {};
}

}  // namespace tidemark::bench
