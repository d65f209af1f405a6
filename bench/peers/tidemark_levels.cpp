// Our host executor, coarse to fine.
#include <chrono>

#include "bench/peers/contestants.h"
#include "document/coarse_levels.h"
#include "solver/coarse_grid.h"
#include "solver/speed/tent_speed.h"

namespace tidemark::bench {
namespace {

Result<Convergence> converge(const Problem& problem) {
  const auto begin = std::chrono::steady_clock::now();
  solver::ExecutorOptions options;
  options.threads = kThreads;
  auto executor =
      solver::make_executor(solver::ExecutorKind::host, problem.source, problem.parameters, options);
  if (!executor) return pass_on(executor);
  document::Start start;
  if (problem.seed) start.seeds.push_back(*problem.seed);
  if (problem.start) start.from = document::MaskStart{std::make_shared<const BitMask>(*problem.start), {}};
  start.levels = solver::levels_for(problem.source->geometry);
  auto coarse = document::run_coarse_levels(
      start,
      {*problem.source, std::make_shared<const solver::TentSpeed>(problem.source, problem.parameters),
       nullptr, problem.parameters, solver::ExecutorKind::host, options, (*executor)->band(),
       (*executor)->memory().page_shape},
      {});
  if (!coarse) return pass_on(coarse);
  if (!*coarse) return fail(ErrorKind::internal, "{}: the coarse levels lost the start", problem.name);
  TIDEMARK_TRY((*executor)->restore((*coarse)->phi));
  auto report = (*executor)->advance({.steps = kMostSteps, .until_converged = true});
  if (!report) return pass_on(report);
  auto phi = (*executor)->snapshot();
  if (!phi) return pass_on(phi);
  Convergence run;
  for (const document::CoarseRun& level : (*coarse)->runs) run.steps += level.advance.steps;
  run.steps += report->steps;
  run.converged = report->converged;
  run.result = phi->mask();
  run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return run;
}

}  // namespace

ContestantKind tidemark_levels() {
  ContestantKind kind;
  kind.name = "host-levels";
  kind.description = "Tidemark host, coarse to fine, 2 threads";
  kind.converge = converge;
  return kind;
}

}  // namespace tidemark::bench
