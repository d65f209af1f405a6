#include "document/lesson_run.h"

#include <utility>

#include "document/executor_setup.h"
#include "imaging/load_study.h"
#include "imaging/phantom/phantom_name.h"

namespace tidemark::document {
namespace {

class LessonRunner {
 public:
  LessonRunner(const Lesson& lesson, std::filesystem::path folder, solver::ExecutorKind kind,
               const solver::ExecutorOptions& options)
      : lesson_(lesson), folder_(std::move(folder)), kind_(kind), options_(options) {}

  Result<LessonOutcome> run(const LessonPart& part, const Progress& progress);

 private:
  Status load(const LessonStudy& study, const Progress& progress);
  Status set_up(const LessonPart& part, const Progress& progress);

  const Lesson& lesson_;
  std::filesystem::path folder_;
  solver::ExecutorKind kind_;
  solver::ExecutorOptions options_;
  std::optional<LessonStudy> loaded_;
  LessonVolume study_;
  std::optional<ExecutorSetup> setup_;
  std::int64_t steps_ = 0;
};

Status LessonRunner::load(const LessonStudy& study, const Progress& progress) {
  if (loaded_ == study) return {};
  auto volume = load_lesson_study(study, folder_, progress);
  if (!volume) return pass_on(volume);
  study_ = std::move(*volume);
  loaded_ = study;
  return {};
}

Status LessonRunner::set_up(const LessonPart& part, const Progress& progress) {
  const LessonTry& attempt = *part.attempt;
  if (attempt.goes_on) {
    if (setup_->smoothed_mm() != attempt.smoothed_mm) {
      TIDEMARK_TRY(setup_->smooth_source(attempt.smoothed_mm, progress));
    }
    return setup_->set_parameters(attempt.parameters);
  }
  auto setup = ExecutorSetup::create(study_.volume, attempt.smoothed_mm, attempt.parameters, kind_, options_);
  if (!setup) return pass_on(setup);
  setup_ = std::move(*setup);
  steps_ = 0;
  const Start* own = lesson_.start_of(part);
  const auto begun = setup_->begin(own != nullptr ? *own : study_.start, progress);
  return begun ? Status() : pass_on(begun);
}

Result<LessonOutcome> LessonRunner::run(const LessonPart& part, const Progress& progress) {
  if (!part.attempt) return LessonOutcome{};
  TIDEMARK_TRY(load(lesson_.study_of(part), progress));
  TIDEMARK_TRY(set_up(part, progress));
  bool rests = false;
  if (part.attempt->steps > 0) {
    auto report = setup_->executor().advance({part.attempt->steps, part.attempt->until_rest, progress});
    if (!report) return pass_on(report);
    if (progress.cancelled()) return cancelled_error();
    steps_ += report->steps;
    rests = report->converged;
  }
  const auto phi = setup_->executor().snapshot();
  if (!phi) return pass_on(phi);
  const LessonState state{
      *phi, steps_, rests, setup_->executor().time_step(), setup_->executor().memory(), study_.truth.get()};
  return measure(part.measures, state, progress);
}

}  // namespace

Result<LessonVolume> load_lesson_study(const LessonStudy& study, const std::filesystem::path& folder,
                                       const Progress& progress) {
  LessonVolume loaded;
  if (study.phantom.empty()) {
    auto volume = imaging::load_volume(folder / study.file, {}, progress);
    if (!volume) return pass_on(volume);
    loaded.volume = std::make_shared<const Volume>(std::move(*volume));
    return loaded;
  }
  const auto name = imaging::parse_phantom_name(study.phantom);
  if (!name) return pass_on(name);
  auto phantom = imaging::make_phantom(name->kind, name->options, progress);
  if (!phantom) return pass_on(phantom);
  loaded.start = suggested_start(phantom->volume.geometry, phantom->seed, phantom->init_threshold);
  loaded.volume = std::make_shared<const Volume>(std::move(phantom->volume));
  loaded.truth = std::make_shared<const BitMask>(phantom->truth);
  return loaded;
}

bool LessonOutcome::holds(const LessonPart& part) const {
  if (figures.size() != part.measures.size()) return false;
  for (std::size_t i = 0; i < figures.size(); ++i) {
    if (!figures[i] || !part.measures[i].holds(*figures[i])) return false;
  }
  return true;
}

Result<LessonOutcome> measure(const std::vector<LessonMeasure>& measures, const LessonState& state,
                              const Progress& progress) {
  LessonOutcome outcome;
  for (const LessonMeasure& measure : measures) {
    auto value = lesson_figure(measure.figure)->measure(state, progress);
    if (!value) return pass_on(value);
    outcome.figures.push_back(*value);
  }
  return outcome;
}

Result<std::vector<LessonOutcome>> carry_out(
    const Lesson& lesson, const std::filesystem::path& folder, solver::ExecutorKind kind,
    const solver::ExecutorOptions& options, const Progress& progress,
    const std::function<void(const LessonPart&, const LessonOutcome&)>& done) {
  LessonRunner runner(lesson, folder, kind, options);
  std::vector<LessonOutcome> outcomes;
  const auto count = static_cast<int>(lesson.parts.size());
  for (int i = 0; i < count; ++i) {
    const LessonPart& part = lesson.parts[static_cast<std::size_t>(i)];
    auto outcome = runner.run(part, progress.part(i, count));
    if (!outcome)
      return fail(outcome.error().kind, "part {} '{}': {}", i + 1, part.title, outcome.error().message);
    if (done) done(part, *outcome);
    outcomes.push_back(std::move(*outcome));
  }
  return outcomes;
}

}  // namespace tidemark::document
