// The figures that a lesson measures: each a name in lesson files, a unit, and how it is taken.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "core/bit_mask.h"
#include "core/progress.h"
#include "solver/executor.h"
#include "solver/field.h"

namespace tidemark::document {

// A level set after a try.
struct LessonState {
  const solver::Field& phi;
  std::int64_t steps = 0;  // since the start
  bool rests = false;
  double time_step = 0.0;
  solver::MemoryReport memory;
  const BitMask* truth = nullptr;  // on phi's grid; null: not known
};

struct LessonFigure {
  std::string_view name;   // "volume_ml"
  std::string_view unit;   // "ml"; empty: a bare number
  std::string_view title;  // "Volume", in English
  int digits = 2;          // behind the point
  // Unset: it does not exist, as the agreement without a truth, or a distance without a surface. Fails
  // (ErrorKind::cancelled).
  Result<std::optional<double>> (*measure)(const LessonState& state, const Progress& progress);
};

[[nodiscard]] std::span<const LessonFigure> lesson_figures();
[[nodiscard]] const LessonFigure* lesson_figure(std::string_view name);  // null: there is none

}  // namespace tidemark::document
