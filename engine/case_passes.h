// The passes of the stream executor on one page, followed while the case goes on.
#pragma once

#include <QElapsedTimer>
#include <QObject>
#include <QTimer>
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>

#include "engine/case_state.h"
#include "engine/newest_question.h"
#include "solver/balance.h"
#include "solver/stream/pass_record.h"

namespace tidemark::engine {

class CaseProxy;

// The next step of a page, as the engine's thread recorded it.
struct RecordedStep {
  solver::PassRecord record;
  std::int64_t step = 0;  // since the start, before the one that is recorded
};

// Lives on the thread of the user interface. While somebody looks, a record of the newest state is asked for,
// one at a time and a few a second; the engine's thread makes it.
class CasePasses : public QObject {
  Q_OBJECT
 public:
  static constexpr int kPauseMs = 150;  // from one question to the next

  explicit CasePasses(CaseProxy& proxy);

  // Which page is followed: the one under the crosshair, or the one where the surface moves most.
  enum class Follow { crosshair, motion };
  void set_follow(Follow follow);
  [[nodiscard]] Follow follow() const { return follow_; }
  // Nothing is recorded while nobody looks.
  void set_watched(bool watched);

  // Null while there is none.
  [[nodiscard]] const std::shared_ptr<const RecordedStep>& recorded() const { return recorded_; }
  // Why there is none; empty: it is on its way, or there is no surface.
  [[nodiscard]] const std::string& problem() const { return problem_; }
  // The executor has passes to record.
  [[nodiscard]] bool available() const;

 signals:
  void changed();

 private:
  // All that the record depends on.
  struct Question {
    std::int64_t page = 0;
    std::int64_t step = 0;
    std::uint64_t edits = 0;
    std::uint64_t history_state = 0;
    solver::Parameters parameters;
    std::shared_ptr<const solver::Field> phi;
    std::shared_ptr<const solver::SpeedFunction> speed;
    std::shared_ptr<const solver::Constraints> constraints;
    std::shared_ptr<const Volume> source;

    bool operator==(const Question&) const = default;
  };
  void look();
  void forget();
  [[nodiscard]] std::optional<glm::dvec3> place();  // voxel coordinates
  [[nodiscard]] std::optional<Question> question();
  void take(const Result<RecordedStep>& answer);

  CaseProxy& proxy_;
  Follow follow_ = Follow::crosshair;
  bool watched_ = false;
  bool waits_ = false;
  std::optional<Question> asked_;
  std::shared_ptr<const RecordedStep> recorded_;
  std::string problem_;
  QTimer pause_;
  NewestQuestion<solver::StepInputs, std::optional<glm::dvec3>> fastest_;
};

}  // namespace tidemark::engine
