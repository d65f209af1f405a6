// A level set as the start of a sweep, and what one of its runs has become.
#include <cstdlib>
#include <utility>

#include "document/level_set.h"

namespace tidemark::document {

Result<SweepStart> LevelSet::sweep_start() {
  if (!begun()) return fail(ErrorKind::usage, "there is no surface yet: a start is needed");
  if (start_ == nullptr) {
    TIDEMARK_TRY(history_.close());
    if (const auto point = start_point(); !point) return pass_on(point);
  }
  if (step() == 0) {
    TIDEMARK_TRY(read_back_phi());  // painted before the first step
  }
  return SweepStart{source(),     start_,         recipe_.start.limit(),
                    parameters(), setup_.drive(), setup_.lacks_speed() ? nullptr : executor().speed()};
}

Status LevelSet::take_run(const SweepStart& start, const SweepRun& run, const Progress& progress) {
  TIDEMARK_TRY(history_.close());
  if (start.phi != start_ || start.source != source()) {
    return fail(ErrorKind::usage, "the surface began in another way since the sweep: sweep again");
  }
  auto point = start_point();
  if (!point) return pass_on(point);
  const Point before = known_;
  point->recipe.set_conditions(run.parameters, run.drive == nullptr ? start.drive : run.drive);
  TIDEMARK_TRY(go_to(std::move(*point)));
  Recipe recipe = recipe_;
  recipe.steps = run.steps;
  return keep(setup_.play(recipe, recipe.events.size(), 0, run.steps, progress), recipe, ChangeKind::sweep,
              before);
}

}  // namespace tidemark::document
