// A lesson without a student: every try carried out and measured, as its author expects it to come out.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "core/bit_mask.h"
#include "document/lesson.h"
#include "document/lesson_figure.h"
#include "solver/executor.h"

namespace tidemark::document {

// The study of a lesson in memory.
struct LessonVolume {
  std::shared_ptr<const Volume> volume;
  std::shared_ptr<const BitMask> truth;  // on the volume's grid; null: not known
  Start start;                           // a phantom's own; empty: none
};
// `folder` holds the lesson's file. Fails as make_phantom() and load_volume() do.
Result<LessonVolume> load_lesson_study(const LessonStudy& study, const std::filesystem::path& folder,
                                       const Progress& progress = {});

// The outcome of a part, in the order of its measures; unset: a figure that does not exist.
struct LessonOutcome {
  std::vector<std::optional<double>> figures;

  // Whether every figure exists and is in its range.
  [[nodiscard]] bool holds(const LessonPart& part) const;
};

// Fails (ErrorKind::cancelled). Each figure is one of lesson_figures().
Result<LessonOutcome> measure(const std::vector<LessonMeasure>& measures, const LessonState& state,
                              const Progress& progress = {});

// One outcome a part; a part to read has no figures. `done` is called after each part. Fails as the study's
// loading and the executor do, naming the part.
Result<std::vector<LessonOutcome>> carry_out(
    const Lesson& lesson, const std::filesystem::path& folder, solver::ExecutorKind kind,
    const solver::ExecutorOptions& options, const Progress& progress = {},
    const std::function<void(const LessonPart&, const LessonOutcome&)>& done = {});

}  // namespace tidemark::document
