// A level set as the start of a sweep, and what one of its runs has become.
#include <cstdlib>
#include <utility>

#include "document/level_set.h"

namespace tidemark::document {
namespace {

// One that is made anew lies elsewhere in memory each time, and in pages of the executor of that time.
bool is_same_start(const std::shared_ptr<const solver::Field>& now,
                   const std::shared_ptr<const solver::Field>& then) {
  if (now == then) return true;
  const Index3 shape = then->layout.page_shape();
  if (now->layout.page_shape() == shape) return solver::same_pages(*now, *then);
  return solver::same_pages(now->repaged(then->band, shape), *then);
}

}  // namespace

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
  if (!is_same_start(point->start, start.phi) || !same_source) {
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
