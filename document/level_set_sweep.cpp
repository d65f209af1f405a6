// A level set as the start of a sweep, and what one of its runs has become.
#include <cstdlib>
#include <utility>

#include "document/level_set.h"

namespace tidemark::document {

Result<SweepStart> LevelSet::sweep_start() {
  if (!begun()) return fail(ErrorKind::usage, "there is no surface yet: a start is needed");
  if (step() == 0) {
    TIDEMARK_TRY(read_back_phi());  // painted before the first step
  }
  const auto point = start_point(parameters(), setup_.drive());
  if (!point) return pass_on(point);
  return SweepStart{source(),     point->start,   recipe_.start.limit(),
                    parameters(), setup_.drive(), setup_.lacks_speed() ? nullptr : executor().speed()};
}

Status LevelSet::take_run(const SweepStart& start, const SweepRun& run, const Progress& progress) {
  TIDEMARK_TRY(history_.close());
  const bool same_source = start.source == source();
  auto point = start_point(run.parameters, run.drive == nullptr ? start.drive : run.drive);
  if (!point) return pass_on(point);
  // One that is made anew lies elsewhere each time.
  const bool same_start = point->start == start.phi || solver::same_pages(*point->start, *start.phi);
  if (!same_start || !same_source) {
    return fail(ErrorKind::usage, "the surface began in another way since the sweep: sweep again");
  }
  const Point before = known_;
  TIDEMARK_TRY(go_to(std::move(*point)));
  Recipe recipe = recipe_;
  recipe.steps = run.steps;
  return keep(setup_.play(recipe, recipe.events.size(), 0, run.steps, progress), recipe, ChangeKind::sweep,
              before);
}

}  // namespace tidemark::document
