#include "engine/lesson_meter.h"

#include "document/lesson_run.h"

namespace tidemark::engine {

void LessonMeter::measure(const std::vector<document::LessonMeasure>& measures, const CaseState& state,
                          std::shared_ptr<const BitMask> truth) {
  run(
      [measures, truth = std::move(truth), phi = state.phi, steps = state.step, rests = state.converged,
       time_step = state.time_step,
       memory = state.memory](const Progress& progress) -> Result<document::LessonOutcome> {
        if (phi == nullptr) return fail(ErrorKind::usage, "there is no surface to measure yet");
        return document::measure(measures, {*phi, steps, rests, time_step, memory, truth.get()}, progress);
      },
      [this](const document::LessonOutcome& outcome) { emit measured(outcome.figures); });
}

}  // namespace tidemark::engine
