// ITK's ThresholdSegmentationLevelSetImageFilter.
#include "bench/peers/paced_filter.h"

namespace tidemark::bench {

ContestantKind itk_threshold() {
  ContestantKind kind;
  kind.name = "itk-threshold";
  kind.description = "ITK threshold level set, 1 thread";
  kind.make = [](const Problem& problem) -> Result<std::unique_ptr<Contestant>> {
    return std::make_unique<PacedFilter<ItkThresholdFilter>>(make_threshold_filter(problem),
                                                             problem.source->geometry);
  };
  kind.converge = [](const Problem& problem) {
    return converge_filter(problem.source->geometry, [&] { return make_threshold_filter(problem); });
  };
  return kind;
}

}  // namespace tidemark::bench
