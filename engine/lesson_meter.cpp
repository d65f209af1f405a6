#include "engine/lesson_meter.h"

#include "document/lesson_figure.h"

namespace tidemark::engine {

void LessonMeter::measure(const std::vector<document::LessonMeasure>& measures, const CaseState& state,
                          std::shared_ptr<const Mask> truth) {
  using Figures = std::vector<std::optional<double>>;
  run(
      [measures, truth = std::move(truth), phi = state.phi, steps = state.step, rests = state.converged,
       time_step = state.time_step, memory = state.memory](const Progress& progress) -> Result<Figures> {
        if (phi == nullptr) return fail(ErrorKind::usage, "there is no surface to measure yet");
        const document::LessonState lesson_state{*phi, steps, rests, time_step, memory, truth.get()};
        Figures figures;
        for (const document::LessonMeasure& measure : measures) {
          auto figure = document::lesson_figure(measure.figure)->measure(lesson_state, progress);
          if (!figure) return pass_on(figure);
          figures.push_back(*figure);
        }
        return figures;
      },
      [this](const Figures& figures) { emit measured(figures); });
}

}  // namespace tidemark::engine
