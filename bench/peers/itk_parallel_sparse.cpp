// ITK's ParallelSparseFieldLevelSetImageFilter with the threshold filter's speed.
#include "bench/peers/paced_filter.h"

namespace tidemark::bench {

ContestantKind itk_parallel_sparse() {
  ContestantKind kind;
  kind.name = "itk-parallel";
  kind.description = "ITK parallel sparse field, 2 threads";
  kind.make = [](const Problem& problem) -> Result<std::unique_ptr<Contestant>> {
    return std::make_unique<PacedFilter<ItkParallelFilter>>(make_parallel_filter(problem, kThreads),
                                                            problem.source->geometry);
  };
  kind.converge = [](const Problem& problem) {
    return converge_filter(problem.source->geometry, [&] { return make_parallel_filter(problem, kThreads); });
  };
  return kind;
}

}  // namespace tidemark::bench
