#include "engine/lesson_jobs.h"

#include <utility>

#include "imaging/phantom/phantom_name.h"

namespace tidemark::engine {
namespace {

constexpr const char* kCarryingOut = "carrying out the lesson";

}  // namespace

LessonJobs::LessonJobs(QObject* parent) : JobRunner(parent) {}

void LessonJobs::load(const std::filesystem::path& file) {
  using Loaded = std::shared_ptr<const document::Lesson>;
  run(
      [file](const Progress&) -> Result<Loaded> {
        auto lesson = document::Lesson::load(file);
        if (!lesson) return pass_on(lesson);
        return std::make_shared<const document::Lesson>(std::move(*lesson));
      },
      [this](const Loaded& lesson) { emit loaded(lesson); });
}

void LessonJobs::carry_out(const document::Lesson& lesson, const std::filesystem::path& folder) {
  run(
      [lesson, folder](const Progress& progress) {
        // Executors name their own steps, which say nothing to who waits for a whole lesson.
        Progress whole{nullptr, progress.stop};
        whole.report = [&](double fraction, std::string_view) { progress(fraction, kCarryingOut); };
        return document::carry_out(lesson, folder, solver::ExecutorKind::host, {}, whole);
      },
      [this](const std::vector<document::LessonOutcome>& outcomes) { emit carried_out(outcomes); });
}

void LessonJobs::suit(const std::string& phantom) {
  run(
      [phantom](const Progress& progress) -> Result<solver::Parameters> {
        const auto name = imaging::parse_phantom_name(phantom);
        if (!name) return pass_on(name);
        const auto made = imaging::make_phantom(name->kind, name->options, progress);
        if (!made) return pass_on(made);
        solver::Parameters parameters;
        parameters.target = made->target;
        parameters.range = made->range;
        parameters.alpha = made->alpha;
        return parameters;
      },
      [this](const solver::Parameters& parameters) { emit suited(parameters); });
}

}  // namespace tidemark::engine
