// The figures of a lesson, taken from a case beside the user interface.
#pragma once

#include <optional>
#include <vector>

#include "core/bit_mask.h"
#include "document/lesson.h"
#include "engine/case_state.h"
#include "engine/job_runner.h"

namespace tidemark::engine {

class LessonMeter : public JobRunner {
  Q_OBJECT
 public:
  explicit LessonMeter(QObject* parent = nullptr) : JobRunner(parent) {}

  // Of a state at rest, in which phi is the present one. Ends with measured() or failed().
  void measure(const std::vector<document::LessonMeasure>& measures, const CaseState& state,
               std::shared_ptr<const BitMask> truth);
  void cancel() { give_up(); }

 signals:
  // In the order of the measures; unset: a figure that does not exist.
  void measured(const std::vector<std::optional<double>>& figures);
};

}  // namespace tidemark::engine
