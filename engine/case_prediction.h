// The prediction of a case's surface from its present radius, made anew whenever something is steered.
#pragma once

#include <QObject>
#include <cstdint>
#include <memory>
#include <optional>

#include "document/prediction.h"
#include "engine/case_state.h"
#include "engine/newest_question.h"

namespace tidemark::engine {

// Lives on the thread of the user interface; it is computed on another one.
class CasePrediction : public QObject {
  Q_OBJECT
 public:
  explicit CasePrediction(QObject* parent = nullptr);

  // The case as it is now. It is predicted from the first measurement on that follows what was done last.
  void follow(const CaseState& state);
  void forget();
  // Null: not known yet.
  [[nodiscard]] const document::Prediction* prediction() const;

 signals:
  void answered();

 private:
  // From where and with what it is predicted.
  struct Base {
    solver::StepInputs inputs;
    std::int64_t step = 0;
    std::int64_t steered_at = 0;
    std::uint64_t steered = 0;
    document::CurvePoint first;  // of the curve: another start has another one

    bool operator==(const Base&) const = default;
  };
  using Answer = std::optional<document::Prediction>;
  static Answer compute(const Base& base, const std::stop_token& stop);
  [[nodiscard]] bool still_holds(const Base& now) const;

  std::optional<Base> base_;
  NewestQuestion<Base, Answer> question_;
};

}  // namespace tidemark::engine
