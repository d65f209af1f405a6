// The comparison of a case with another state of its history.
#pragma once

#include <QObject>
#include <cstdint>
#include <memory>
#include <optional>

#include "engine/case_state.h"
#include "engine/newest_question.h"
#include "solver/surface_agreement.h"

namespace tidemark::engine {

// Lives on the thread of the user interface; figures are computed on another one, when the surface rests.
class StateComparison : public QObject {
  Q_OBJECT
 public:
  using Phi = std::shared_ptr<const solver::Field>;
  using Agreement = std::optional<solver::SurfaceAgreement>;

  explicit StateComparison(QObject* parent = nullptr);

  // A state of the case as it was last followed. Unset: nothing is compared any more.
  void choose(std::optional<std::uint64_t> state);
  // The case as it is now.
  void follow(const CaseState& state);

  [[nodiscard]] std::optional<std::uint64_t> state() const { return chosen_; }
  // Of the chosen state; null: there is none.
  [[nodiscard]] const Phi& phi() const { return phi_; }
  // With the present surface, as it was when it last rested; unset until it is known.
  [[nodiscard]] const Agreement& agreement() const;

 signals:
  void changed();

 private:
  struct Question {
    Phi present;
    Phi other;

    bool operator==(const Question&) const = default;
  };
  static Agreement agreement_of(const Question& question, const std::stop_token& stop);
  void compare();

  std::optional<std::uint64_t> chosen_;
  Phi phi_;
  std::shared_ptr<const HistoryRows> rows_;
  Phi present_;  // the newest
  NewestQuestion<Question, Agreement> question_;
};

}  // namespace tidemark::engine
