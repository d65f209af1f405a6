// tidemark-cli bench: how fast this machine computes.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>

#include "app/cli/arguments.h"
#include "app/cli/program.h"
#include "app/cli/report.h"
#include "app/cli/solver_options.h"
#include "core/index_walk.h"
#include "imaging/filters/filters.h"
#include "imaging/phantom/phantom.h"
#include "solver/distance_transform.h"
#include "solver/model.h"

namespace tidemark::cli {
namespace {

constexpr CommandHelp kBench{
    "bench", "Measures how fast the solver is here",
    "Measures the solver on a phantom made in memory: steps/s and voxel updates/s (voxels really computed) "
    "over\n"
    "three stages of equal length from the start (early, middle, late), then the run to convergence and the\n"
    "cost of steps when everything rests. Machines drift: compare figures of one run, take the median of "
    "several.",
    "  tidemark-cli bench\n"
    "  tidemark-cli bench --case cortex --threads 2 --json\n"
    "  tidemark-cli bench --case sphere --size 256 --steps 300            256 x 256 x 256 voxels\n"};

constexpr std::int64_t kDefaultSteps = 100;
constexpr std::int64_t kDefaultSize = 128;

struct BenchOptions {
  std::string kind = "tumour";
  std::optional<std::int64_t> size;   // of the sphere's volume, in voxels along each axis
  std::optional<std::int64_t> steps;  // in each stage
  SolverOptions solver;
};

// A case of the benchmark, with its start.
struct Case {
  std::shared_ptr<const Volume> volume;
  solver::Parameters parameters;
  std::array<double, 4> seed{};  // i, j, k, radius in mm; used without a start
  std::optional<solver::Field> start;
};

// A bright ball with a soft edge that fills most of a cube of `size` voxels of 1 mm.
Case make_ball(std::int64_t size) {
  auto volume = std::make_shared<Volume>();
  volume->geometry.size = Index3(size);
  std::vector<std::int16_t> voxels;
  voxels.reserve(static_cast<std::size_t>(volume->geometry.voxel_count()));
  const double middle = 0.5 * static_cast<double>(size - 1);
  const double radius = 0.35 * static_cast<double>(size);
  for_each_index(Index3(0), Index3(size), [&](Index3 voxel) {
    const double distance = glm::length(glm::dvec3(voxel) - middle) - radius;
    voxels.push_back(static_cast<std::int16_t>(std::lround(1000.0 * std::clamp(0.5 - distance, 0.0, 1.0))));
  });
  volume->voxels = std::move(voxels);
  Case result;
  result.volume = std::move(volume);
  result.parameters.target = 1000.0;
  result.parameters.range = 500.0;
  result.parameters.alpha = 0.8;
  result.seed = {middle, middle, middle, std::max(3.0, 0.5 * radius)};
  return result;
}

Result<Case> make_case(const BenchOptions& options, Console& console) {
  if (options.kind == "sphere") return make_ball(options.size.value_or(kDefaultSize));
  auto phantom = imaging::make_phantom(options.kind, {}, console.progress());
  if (!phantom) return pass_on(phantom);
  if (!phantom->seed && !phantom->init_threshold)
    return fail(ErrorKind::internal, "the phantom {} has no start", options.kind);
  Case result;
  result.parameters.target = phantom->target;
  result.parameters.range = phantom->range;
  result.parameters.alpha = phantom->alpha;
  result.volume = std::make_shared<const Volume>(std::move(phantom->volume));
  if (phantom->init_threshold) {
    // The whole surface is there from the first step; a seed would take a thousand to reach it.
    const auto& [low, high] = *phantom->init_threshold;
    result.start = solver::distance_transform(imaging::between(*result.volume, low, high),
                                              solver::default_band(result.volume->geometry));
  } else {
    result.seed = *phantom->seed;
  }
  return result;
}

Status check(const BenchOptions& options) {
  if (options.kind != "tumour" && options.kind != "cortex" && options.kind != "sphere") {
    return fail(ErrorKind::usage, "--case '{}' is unknown; use tumour, cortex or sphere", options.kind);
  }
  if (options.size && options.kind != "sphere") {
    return fail(ErrorKind::usage, "--size goes with --case sphere: the other cases have a size of their own");
  }
  if (options.size && (*options.size < 16 || *options.size > 1024)) {
    return fail(ErrorKind::usage, "--size {}: must be 16 to 1024 voxels", *options.size);
  }
  if (options.steps && (*options.steps < 1 || *options.steps > 1'000'000)) {
    return fail(ErrorKind::usage, "--steps {}: must be 1 to 1000000", *options.steps);
  }
  return check(options.solver);
}

struct Stage {
  std::string name;
  solver::AdvanceReport report;
  solver::MemoryReport memory;

  [[nodiscard]] double paging_share() const {
    return report.seconds > 0.0 ? report.paging_seconds / report.seconds : 0.0;
  }
};

Json to_json(const Stage& stage) {
  Json object;
  object["stage"] = stage.name;
  object["steps"] = stage.report.steps;
  object["seconds"] = stage.report.seconds;
  object["steps_per_second"] = steps_per_second(stage.report);
  object["voxel_updates_per_second"] = voxel_updates_per_second(stage.report);
  object["paging_share"] = stage.paging_share();
  object["resident_pages"] = stage.memory.resident_pages;
  object["quiet_pages"] = stage.memory.quiet_pages;
  object["converged"] = stage.report.converged;
  return object;
}

constexpr std::string_view kConverged = "converged";

// A surface that has stopped moving still has pages that fall asleep one after the other.
Status let_rest(solver::Executor& solver) {
  constexpr std::int64_t kSteps = 100;
  for (std::int64_t done = 0; done < 20 * kSteps; done += kSteps) {
    const solver::MemoryReport memory = solver.memory();
    if (memory.quiet_pages == memory.resident_pages) break;
    TIDEMARK_TRY(solver.advance({.steps = kSteps}));
  }
  return {};
}

Result<std::vector<Stage>> measure_stages(solver::Executor& solver, std::int64_t steps, Console& console) {
  struct Plan {
    std::string_view name;
    std::int64_t steps;
    bool until_converged;
  };
  std::vector<Stage> stages;
  // Kernels are compiled with their first step.
  TIDEMARK_TRY(solver.advance({}));
  for (const Plan& plan :
       {Plan{"early", steps, false}, Plan{"middle", steps, false}, Plan{"late", steps, false},
        Plan{"to convergence", solver::kMostStepsToRest, true}, Plan{kConverged, steps, false}}) {
    if (plan.name == kConverged) {
      TIDEMARK_TRY(let_rest(solver));
    }
    const auto report = solver.advance(solver::Advance{plan.steps, plan.until_converged, console.progress()});
    if (!report) return pass_on(report);
    if (console.interrupted()) return cancelled_error();
    stages.push_back({std::string(plan.name), *report, solver.memory()});
  }
  return stages;
}

void say_stages(Console& console, const std::vector<Stage>& stages) {
  console.say("{:<15}{:>8}{:>10}{:>12}{:>16}{:>9}{:>8}{:>8}", "stage", "steps", "seconds", "steps/s",
              "Mvoxel upd./s", "paging", "pages", "quiet");
  for (const Stage& stage : stages) {
    console.say("{:<15}{:>8}{:>10.4f}{:>12.0f}{:>16.1f}{:>7.1f} %{:>8}{:>8}", stage.name, stage.report.steps,
                stage.report.seconds, steps_per_second(stage.report),
                voxel_updates_per_second(stage.report) / 1e6, 100.0 * stage.paging_share(),
                stage.memory.resident_pages, stage.memory.quiet_pages);
  }
}

Status begin(solver::Executor& solver, const Case& benchmark) {
  if (benchmark.start) return solver.restore(*benchmark.start);
  const auto& [i, j, k, radius_mm] = benchmark.seed;
  return solver.paint(solver::sphere_at_voxel(benchmark.volume->geometry, {i, j, k}, radius_mm),
                      solver::Brush::add);
}

Status run(Program& program, const BenchOptions& options) {
  Console& console = program.console;
  TIDEMARK_TRY(check(options));
  const auto benchmark = make_case(options, console);
  if (!benchmark) return pass_on(benchmark);
  if (console.interrupted()) return cancelled_error();
  solver::ExecutorOptions executor_options = options.solver.executor_options();
  executor_options.time_paging = true;
  auto executor = solver::make_executor(options.solver.kind.value_or(solver::ExecutorKind::automatic),
                                        benchmark->volume, benchmark->parameters, executor_options);
  if (!executor) return pass_on(executor);
  solver::Executor& solver = **executor;
  TIDEMARK_TRY(begin(solver, *benchmark));
  const auto stages = measure_stages(solver, options.steps.value_or(kDefaultSteps), console);
  if (!stages) return pass_on(stages);

  const solver::MemoryReport memory = solver.memory();
  const double active = 1.0 / std::max(1e-12, steps_per_second((*stages)[2].report));
  const double converged = 1.0 / std::max(1e-12, steps_per_second(stages->back().report));
  const Index3 size = benchmark->volume->geometry.size;
  console.say("{} {} x {} x {}, executor {}", options.kind, size.x, size.y, size.z, solver.name());
  say_stages(console, *stages);
  console.say("solver state    {:.2f} bytes per resident voxel at most", bytes_per_resident_voxel(memory));
  console.say("converged step  {:.2f} microseconds, {:.2f} % of a late one", 1e6 * converged,
              100.0 * converged / active);

  Json object;
  object["case"] = options.kind;
  object["executor"] = solver.name();
  object.update(grid_json(benchmark->volume->geometry));
  object["stages"] = Json::array();
  for (const Stage& stage : *stages) object["stages"].push_back(to_json(stage));
  object["bytes_per_resident_voxel"] = bytes_per_resident_voxel(memory);
  object["page_bytes"] = memory.state_bytes;
  object["peak_page_bytes"] = memory.peak_state_bytes;
  object["converged_step_seconds"] = converged;
  console.result(object);
  return {};
}

}  // namespace

void add_bench(CLI::App& app, Program& program) {
  auto options = std::make_shared<BenchOptions>();
  CLI::App& command =
      add_command(app, program, kBench, [&program, options] { return run(program, *options); });
  command.add_option("--case", options->kind, "What to segment (default: tumour)")
      ->type_name("tumour|cortex|sphere");
  add_count(command, "--size", options->size,
            "With --case sphere: voxels along each axis, 16 to 1024 (default: 128)");
  add_count(command, "--steps", options->steps, "Steps in each stage (default: 100)");
  add_solver_options(command, options->solver);
}

}  // namespace tidemark::cli
