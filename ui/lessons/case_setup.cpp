#include "ui/lessons/case_setup.h"

#include <QCoreApplication>
#include <QStringList>
#include <algorithm>

#include "ui/lessons/parameter_names.h"
#include "ui/widgets/path_text.h"

namespace tidemark::ui {
namespace {

using document::Start;

QString setup_text(const char* words) {
  return QCoreApplication::translate("CaseSetup", words);
}

// As carry_out() begins without another start.
Start own_start(const engine::LoadedStudy& study) {
  const engine::PhantomStart known = study.start.value_or(engine::PhantomStart{});
  return document::suggested_start(study.volume->geometry, known.seed, known.threshold);
}

// Masks and saved level sets are of one study's grid: lesson files have none.
bool can_be_written(const Start& start) {
  return !std::holds_alternative<document::MaskStart>(start.from) &&
         !std::holds_alternative<document::FieldStart>(start.from);
}

// How many steps the tries compute from which the part goes on.
std::int64_t steps_before(const document::Lesson& lesson, std::size_t part) {
  std::int64_t steps = 0;
  for (std::size_t i = part; i-- > 0;) {
    const auto& attempt = lesson.parts[i].attempt;
    if (!attempt) continue;
    steps += attempt->steps;
    if (!attempt->goes_on) break;
  }
  return steps;
}

void add_remarks(const CaseSetup& setup, QStringList& said) {
  if (!setup.is_plain) {
    said << setup_text(QT_TRANSLATE_NOOP(
        "CaseSetup", "The case is driven or held by more than T and ε, which a lesson does not have."));
  }
  if (setup.was_edited) {
    said << setup_text(QT_TRANSLATE_NOOP(
        "CaseSetup", "The case was changed on its way, so that the lesson's run can end elsewhere."));
  }
}

void take_start(const CaseSetup& setup, const Start* inherited, std::optional<Start>& start,
                QStringList& said) {
  if (!can_be_written(setup.start)) {
    said << setup_text(QT_TRANSLATE_NOOP(
        "CaseSetup",
        "The case begins with a mask or a saved level set, which a lesson does not hold: begin the case with "
        "seeds, a threshold or a flood."));
    return;
  }
  const Start& without = inherited != nullptr ? *inherited : setup.phantoms_own;
  start.reset();
  if (setup.start != without) start = setup.start;
}

// Spheres that were drawn before the first step are seeds and erasers of the start. Those of `events` that
// are something else stay, as does what was added after something was erased: a start erases last.
std::vector<document::RecipeEvent> with_spheres_taken(Start& start,
                                                      const std::vector<document::RecipeEvent>& events) {
  std::vector<document::RecipeEvent> rest;
  for (const document::RecipeEvent& event : events) {
    const auto* paint = std::get_if<document::PaintEvent>(&event.what);
    const bool adds = paint && paint->brush == solver::Brush::add;
    if (!paint || event.step > 0 || (adds && !start.erasers.empty())) {
      rest.push_back(event);
    } else {
      (adds ? start.seeds : start.erasers).push_back(paint->sphere);
    }
  }
  return rest;
}

}  // namespace

bool CaseSetup::is_on(const document::LessonStudy& study, const std::filesystem::path& folder) const {
  if (!study.phantom.empty()) {
    const auto kind = [](const std::string& name) { return name.substr(0, name.find(':')); };
    return kind(study.phantom) == kind(origin.phantom);
  }
  if (origin.path.empty() || folder.empty()) return false;
  return is_same_file(folder / study.file, origin.path);
}

void take_setup(engine::CaseProxy& proxy, std::function<void(const CaseSetup&)> answer,
                std::function<void()> gave_up) {
  proxy.take_snapshot(
      {},
      [own = own_start(proxy.study()), answer = std::move(answer)](const auto& snapshot) {
        const document::SessionContents& contents = snapshot->contents;
        const document::Recipe& recipe = contents.recipe;
        CaseSetup setup;
        setup.origin = contents.origin;
        setup.start = recipe.start;
        setup.phantoms_own = own;
        setup.parameters = recipe.final_parameters();
        setup.smoothed_mm = recipe.final_smoothed_mm();
        setup.steps = recipe.steps;
        setup.is_plain = document::is_plain(document::value_of(recipe.final_drive()));
        const auto events = with_spheres_taken(setup.start, recipe.events);
        // Before the first step a change is a part of the start's setting, except for strokes.
        setup.was_edited = std::any_of(events.begin(), events.end(), [](const auto& event) {
          if (std::holds_alternative<document::PaintEvent>(event.what)) return true;
          return event.step > 0 && !std::holds_alternative<document::ResumeEvent>(event.what) &&
                 !std::holds_alternative<document::ExecutorEvent>(event.what);
        });
        answer(setup);
      },
      std::move(gave_up));
}

QString put_into_part(const CaseSetup& setup, document::Lesson& lesson, std::size_t index,
                      const std::filesystem::path& folder) {
  QStringList said;
  document::LessonPart& part = lesson.parts[index];
  if (!part.attempt) part.attempt.emplace();
  document::LessonTry& attempt = *part.attempt;
  attempt.parameters = setup.parameters;
  attempt.smoothed_mm = setup.smoothed_mm;
  attempt.steps = setup.steps;
  if (attempt.goes_on) {
    attempt.steps = std::max<std::int64_t>(setup.steps - steps_before(lesson, index), 0);
  } else if (setup.start.empty()) {
    said << setup_text(QT_TRANSLATE_NOOP("CaseSetup", "The case has no surface yet, so no start was taken."));
  } else if (!setup.is_on(lesson.study_of(part), folder)) {
    said << setup_text(QT_TRANSLATE_NOOP(
        "CaseSetup", "The case is of another study than the part, so its start was not taken."));
  } else {
    const bool own_study = part.study && !(*part.study == lesson.study);
    take_start(setup, !own_study && lesson.start ? &*lesson.start : nullptr, attempt.start, said);
  }
  add_remarks(setup, said);
  return said.join(u' ');
}

QString put_into_lesson(const CaseSetup& setup, document::Lesson& lesson,
                        const std::filesystem::path& folder) {
  QStringList said;
  const solver::Parameters before = lesson.parameters;
  lesson.parameters = setup.parameters;
  for (document::LessonPart& part : lesson.parts) {
    if (part.attempt) follow(part.attempt->parameters, before, lesson.parameters);
  }
  if (!setup.origin.phantom.empty()) {
    if (!setup.is_on(lesson.study, folder)) lesson.study = {setup.origin.phantom, {}};
  } else if (!setup.is_on(lesson.study, folder)) {
    said << setup_text(QT_TRANSLATE_NOOP(
        "CaseSetup",
        "The case is of another study than the lesson: choose its file first, so that the start fits."));
  }
  if (!setup.start.empty() && setup.is_on(lesson.study, folder))
    take_start(setup, nullptr, lesson.start, said);
  add_remarks(setup, said);
  return said.join(u' ');
}

}  // namespace tidemark::ui
