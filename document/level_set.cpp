#include "document/level_set.h"

#include <algorithm>
#include <utility>

namespace tidemark::document {
namespace {

// Of events that follow each other without a step between, whether the last counts alone. A wall that is
// taken away again has moved the surface.
bool replaces(const RecipeEvent& event, const RecipeEvent& before) {
  if (std::holds_alternative<ParametersEvent>(event.what)) {
    return std::holds_alternative<ParametersEvent>(before.what);
  }
  const auto* now = std::get_if<DriveEvent>(&event.what);
  const auto* then = std::get_if<DriveEvent>(&before.what);
  return now != nullptr && then != nullptr && cover(*now->drive, *then->drive);
}

// Whether phi at the end of that recipe is the same where this drive alone has held it from the start on.
bool covers_all(const Drive& drive, const Recipe& recipe) {
  const auto covers = [&](const RecipeEvent& event) {
    const auto* then = std::get_if<DriveEvent>(&event.what);
    return then == nullptr || cover(drive, *then->drive);
  };
  return cover(drive, value_of(recipe.drive)) &&
         std::all_of(recipe.events.begin(), recipe.events.end(), covers);
}

}  // namespace

Result<std::unique_ptr<LevelSet>> LevelSet::create(std::shared_ptr<const Volume> volume,
                                                   const solver::Parameters& parameters,
                                                   solver::ExecutorKind kind,
                                                   const solver::ExecutorOptions& options, History& history) {
  auto setup = ExecutorSetup::create(std::move(volume), 0.0, parameters, kind, options);
  if (!setup) return pass_on(setup);
  return std::unique_ptr<LevelSet>(new LevelSet(std::move(*setup), parameters, history));
}

LevelSet::LevelSet(ExecutorSetup setup, const solver::Parameters& parameters, History& history)
    : setup_(std::move(setup)), history_(history) {
  const Geometry& geometry = setup_.volume()->geometry;
  recipe_.source.size = geometry.size;
  recipe_.source.spacing_mm = geometry.spacing_mm;
  recipe_.executor = setup_.description();
  recipe_.parameters = parameters;
  start_ = std::make_shared<const solver::Field>(
      solver::Field::empty(geometry, executor().band(), recipe_.executor.page_shape));
  put_in_place({recipe_, start_, start_});
  history_.set_steering(steering_of(known_));
}

// Where phi was put back, the recipe says so, and into which executor.
void LevelSet::append_resumption() {
  if (!std::exchange(resumed_, false) || step() == 0) return;
  const RecipeExecutor present = setup_.description();
  if (present == recipe_.final_executor()) {
    recipe_.events.push_back({step(), ResumeEvent{}});
  } else {
    recipe_.events.push_back({step(), ExecutorEvent{present}});
  }
}

// Before the first step no other executor has a part in it.
void LevelSet::settle_executor(Recipe& recipe) const {
  if (recipe.steps == 0) recipe.set_executor(setup_.description());
}

// Appends to the recipe, after what put phi back.
void LevelSet::append(RecipeEvent event) {
  append_resumption();
  recipe_.events.push_back(std::move(event));
}

// The same, in place of an event that does not count any more.
void LevelSet::record(RecipeEvent event) {
  std::vector<RecipeEvent>& events = recipe_.events;
  const bool resumes = resumed_ && step() > 0;
  if (!resumes && !events.empty() && events.back().step == event.step && replaces(event, events.back())) {
    events.pop_back();
  }
  append(std::move(event));
}

Status LevelSet::read_back_phi() {
  if (!dirty_) {
    Recipe recipe = recipe_;
    known_.recipe = std::move(recipe);
    known_.start = start_;
    known_.curve = curve_;
    known_.drive = drive_;
    return {};
  }
  auto phi = executor().snapshot();
  if (!phi) return pass_on(phi);
  auto shared = std::make_shared<const solver::Field>(std::move(*phi));
  if (step() == 0) start_ = shared;
  known_ = {recipe_, std::move(shared), start_, curve_, drive_};
  dirty_ = false;
  return {};
}

Result<std::shared_ptr<const solver::Field>> LevelSet::checkpoint() {
  TIDEMARK_TRY(read_back_phi());
  if (open_ && open_->gesture != 0 && !open_->last_edit) {
    const std::vector<RecipeEvent>& events = recipe_.events;
    const bool computed_since = events.empty() || events.back().step < step();
    if (computed_since && begun()) open_->last_edit = known_;
  }
  return known_.phi;
}

Status LevelSet::begin(const Start& start, const Progress& progress) {
  TIDEMARK_TRY(history_.close());
  auto phi = setup_.begin(start, progress);
  if (!phi) {
    TIDEMARK_TRY(go_to(known_));
    return pass_on(phi);
  }
  Point before = known_;
  Point point{{}, std::make_shared<const solver::Field>(std::move(*phi)), nullptr};
  point.recipe.source = recipe_.source;
  point.recipe.executor = setup_.description();
  point.recipe.smoothed_mm = smoothed_mm();
  point.recipe.start = start;
  point.recipe.parameters = parameters();
  point.start = point.phi;
  point.drive = drive_;
  point.recipe.drive = setup_.drive();
  put_in_place(std::move(point));
  enter(ChangeKind::start, std::move(before));
  return {};
}

Status LevelSet::paint(const solver::Sphere& sphere, solver::Brush brush, std::uint64_t gesture) {
  TIDEMARK_TRY(end_other_change(gesture));
  TIDEMARK_TRY(executor().paint(sphere, brush));
  begin_change(brush == solver::Brush::add ? ChangeKind::paint : ChangeKind::erase, gesture, known_);
  record({step(), PaintEvent{sphere, brush}});
  curve_.cut(step());
  dirty_ = true;
  return gesture == 0 ? history_.close() : Status();
}

Status LevelSet::set_parameters(const solver::Parameters& parameters, std::uint64_t gesture) {
  TIDEMARK_TRY(end_other_change(gesture));
  if (parameters == this->parameters()) return {};
  if (!setup_.has_band_of(parameters)) return begin_again_with(parameters);
  TIDEMARK_TRY(setup_.set_parameters(parameters));
  begin_change(ChangeKind::parameters, gesture, known_);
  if (begun()) {
    record({step(), ParametersEvent{parameters}});
  } else {
    recipe_.parameters = parameters;
  }
  return gesture == 0 ? history_.close() : Status();
}

Result<solver::AdvanceReport> LevelSet::advance(const solver::Advance& run) {
  if (!begun()) return fail(ErrorKind::usage, "there is no surface yet: a start is needed");
  if (step() == 0 && dirty_) {
    TIDEMARK_TRY(read_back_phi());  // restart() comes back to it
  }
  TIDEMARK_TRY(setup_.make_missing_speed({nullptr, run.progress.stop}));
  auto report = executor().advance(run);
  const std::int64_t steps = executor().steps_of_last_run();
  if (steps == 0) return report;
  if (!open_) begin_change(ChangeKind::evolution, 0, known_);
  append_resumption();
  recipe_.steps += steps;
  dirty_ = true;
  return report;
}

void LevelSet::put_in_place(Point point) {
  point.curve.compare_with(answer_);
  Point copy = point;  // whatever may lack memory comes first: nothing is in place by half
  Recipe recipe = point.recipe;
  recipe_ = std::move(recipe);
  start_ = point.start;
  curve_ = point.curve;
  drive_ = point.drive;
  known_ = std::move(point);
  in_place_ = std::move(copy);
  dirty_ = false;
  resumed_ = false;
  on_its_way_ = false;
}

// Puts the point's phi and conditions into the executor. A function is made when it is needed: who is asked
// for pictures alone does not wait for it.
Status LevelSet::hand_over(const Point& point) {
  const Recipe& recipe = point.recipe;
  TIDEMARK_TRY(setup_.set_limit(recipe.start.limit()));
  TIDEMARK_TRY(
      setup_.set_conditions(recipe.final_smoothed_mm(), recipe.final_parameters(), recipe.final_drive()));
  return executor().restore(*point.phi);
}

// When there is no room for the point, goes back to known_; no edit stays open then.
Status LevelSet::go_to(Point point) {
  Status gone = hand_over(point);
  if (!gone) {
    if (Status back = hand_over(known_); !back) return gone;
    point = known_;
  }
  settle_executor(point.recipe);
  point.recipe.source = recipe_.source;
  put_in_place(std::move(point));
  resumed_ = true;
  return gone;
}

Status LevelSet::resume_from(const Recipe& recipe, std::shared_ptr<const solver::Field> phi,
                             const Curve& curve, const std::shared_ptr<const Drive>& wanted_drive) {
  TIDEMARK_TRY(history_.close());
  auto drive = drive_of(recipe, wanted_drive);
  TIDEMARK_TRY(go_to({recipe, phi, recipe.steps == 0 ? phi : nullptr, curve, std::move(drive)}));
  settled_events_ = recipe_.events.size();
  history_.set_steering(steering_of(known_));
  return {};
}

void LevelSet::note(const CurvePoint& point) {
  curve_.add(point);
  if (!dirty_) known_.curve = curve_;
}

// Brings the executor to the start of a recipe that has no steps, with its edits.
Status LevelSet::play_start(const Recipe& recipe) {
  TIDEMARK_TRY(setup_.set_conditions(recipe.smoothed_mm, recipe.parameters, recipe.drive));
  TIDEMARK_TRY(setup_.begin(recipe.start, {}));
  return setup_.play(recipe, 0, 0, 0, {});
}

// Brings the executor back to the recipe's start, with the edits that were made before the first step. They
// are in start_ already: a wall among them that was taken away again does not cut it once more.
Status LevelSet::prepare_start() {
  if (start_ == nullptr) return play_start(recipe_.up_to(0));
  return hand_over({recipe_.up_to(0), start_, start_});
}

Status LevelSet::compute_again(std::int64_t target, const Progress& progress) {
  if (in_place_.recipe.steps > 0 && in_place_.recipe.steps <= target) {
    TIDEMARK_TRY(hand_over(in_place_));
    const Recipe& from = in_place_.recipe;
    return setup_.play(recipe_, from.events.size(), from.steps, target, progress);
  }
  const RecipeExecutor present = setup_.description();
  if (recipe_.executor != present && !setup_.use(recipe_.executor)) recipe_.set_executor(present);
  TIDEMARK_TRY(prepare_start());
  std::size_t first_event = 0;
  while (first_event < recipe_.events.size() && recipe_.events[first_event].step == 0) ++first_event;
  return setup_.play(recipe_, first_event, 0, target, progress);
}

Status LevelSet::step_back(std::int64_t steps, const Progress& progress) {
  TIDEMARK_TRY(history_.close());
  const std::int64_t target = step() - std::clamp<std::int64_t>(steps, 0, step());
  if (target == step()) return {};
  Point before = known_;
  const RecipeExecutor present = setup_.description();
  const solver::ExecutorKind kind = setup_.kind();
  const solver::ExecutorOptions options = setup_.options();
  Status computed = compute_again(target, progress);
  const bool was_elsewhere = setup_.description() != present || setup_.kind() != kind;
  if (was_elsewhere) {
    const auto phi = executor().snapshot();
    if (computed && !phi) computed = pass_on(phi);
    Status back = setup_.change_executor(kind, options, phi ? *phi : *known_.phi);
    if (computed) computed = std::move(back);
  }
  TIDEMARK_TRY(keep(std::move(computed), recipe_.up_to(target), ChangeKind::step_back, std::move(before)));
  if (was_elsewhere) {
    in_place_ = known_;
    resumed_ = true;
    return {};
  }
  if (in_place_.recipe.steps > target) in_place_ = {recipe_.up_to(0), start_, start_, {}, drive_};
  return {};
}

// The executor has computed the recipe from its start or from in_place_: an entry after `before`. Where it
// has not, the level set is at `before` again.
Status LevelSet::keep(Status computed, Recipe recipe, ChangeKind kind, Point before) {
  if (computed) {
    recipe_ = std::move(recipe);
    take_drive_of_recipe();
    curve_.cut(step());
    resumed_ = false;
    dirty_ = true;
    computed = read_back_phi();
  }
  if (!computed) {
    TIDEMARK_TRY(go_to(std::move(before)));
    return computed;
  }
  enter(kind, std::move(before));
  return {};
}

// phi at the start of a recipe that has no steps. The executor is left there, whatever comes of it.
Result<std::shared_ptr<const solver::Field>> LevelSet::played_start(const Recipe& recipe) {
  TIDEMARK_TRY(play_start(recipe));
  auto phi = executor().snapshot();
  if (!phi) return pass_on(phi);
  return std::make_shared<const solver::Field>(std::move(*phi));
}

// The same, and back to the present point. Ends what goes on.
Result<std::shared_ptr<const solver::Field>> LevelSet::start_made_anew(const Recipe& recipe) {
  TIDEMARK_TRY(history_.close());
  auto phi = played_start(recipe);
  TIDEMARK_TRY(go_to(known_));
  return phi;
}

// The start as it was before the first step, for another run with those conditions. Where walls or anchors
// are gone that have moved it, its new recipe leads elsewhere than to start_: it is made from that one.
Result<LevelSet::Point> LevelSet::start_point(const solver::Parameters& parameters,
                                              const std::shared_ptr<const Drive>& drive) {
  Recipe recipe = recipe_.up_to(0);
  const bool is_held = covers_all(value_of(drive), recipe);
  settle_start(recipe);
  recipe.set_conditions(parameters, drive);
  if (is_held && start_ == nullptr) {
    // It was saved later than its start: what lies between is made again.
    auto phi = start_made_anew(recipe_.up_to(0));
    if (!phi) return pass_on(phi);
    start_ = known_.start = std::move(*phi);
  }
  Point point{std::move(recipe), start_, start_, {}, drive_};
  if (!is_held) {
    auto phi = start_made_anew(point.recipe);
    if (!phi) return pass_on(phi);
    point.phi = point.start = std::move(*phi);
  }
  return point;
}

// The recipe of a start becomes that of another run: with its paint, and smoothed as the source is now.
void LevelSet::settle_start(Recipe& start) const {
  std::erase_if(start.events,
                [](const RecipeEvent& event) { return !std::holds_alternative<PaintEvent>(event.what); });
  if (const double smoothed = smoothed_mm(); smoothed != start.smoothed_mm)
    start.events.push_back({0, SmoothEvent{smoothed}});
}

Status LevelSet::restart() {
  TIDEMARK_TRY(history_.close());
  if (step() == 0) return {};
  Point before = known_;
  auto point = start_point(parameters(), setup_.drive());
  if (!point) return pass_on(point);
  if (const auto& held = executor().constraints(); held != nullptr) {
    // Walls that came after the first step hold phi, too; start() is left as it was.
    solver::Field phi = *point->phi;
    solver::constrain(phi, *held);
    point->phi = std::make_shared<const solver::Field>(std::move(phi));
  }
  TIDEMARK_TRY(go_to(std::move(*point)));
  enter(ChangeKind::restart, std::move(before));
  return {};
}

Status LevelSet::change_executor(solver::ExecutorKind kind, const solver::ExecutorOptions& options) {
  TIDEMARK_TRY(history_.close());
  // Nothing is open any more: what cannot be read back now is lost.
  if (dirty_ && !read_back_phi()) return rebuild(options, kind);
  TIDEMARK_TRY(setup_.change_executor(kind, options, *known_.phi));
  settle_executor(recipe_);
  known_.recipe = recipe_;
  in_place_ = known_;
  resumed_ = true;
  return {};
}

Status LevelSet::rebuild(const solver::ExecutorOptions& options, std::optional<solver::ExecutorKind> kind) {
  Status rebuilt = setup_.change_executor(kind.value_or(setup_.kind()), options, *known_.phi);
  if (!rebuilt) return rebuilt;
  if (open_) open_->last_edit.reset();
  const solver::Parameters present = parameters();
  const auto wanted = drive_;
  TIDEMARK_TRY(go_to(known_));
  if (!open_ && wanted->constraints != drive_->constraints) {
    TIDEMARK_TRY(set_drive(*wanted));  // the entry that had them could not be made
  }
  drive_ = known_.drive = wanted;
  if (Drive now = drive_in_use(); now.constraints != wanted->constraints) {
    now.constraints = wanted->constraints;
    TIDEMARK_TRY(use(now, executor().speed(), Entry::none));
  }
  if (present == parameters()) return {};
  if (!open_) return set_parameters(present);
  // What goes on has set them.
  TIDEMARK_TRY(setup_.set_parameters(present));
  if (begun()) {
    record({step(), ParametersEvent{present}});
  } else {
    recipe_.parameters = present;
  }
  return {};
}

}  // namespace tidemark::document
