// The comparison of a case with another state of its history.
#pragma once

#include <QObject>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>

#include "engine/case_state.h"
#include "solver/surface_agreement.h"

namespace tidemark::engine {

class BackgroundJob;

// Lives on the thread of the user interface; figures are computed on another one, when the surface rests.
class StateComparison : public QObject {
  Q_OBJECT
 public:
  using Phi = std::shared_ptr<const solver::Field>;
  // Asks for phi of a state; the answer comes later, null when there is none any more, or never.
  using AskForPhi = std::function<void(std::uint64_t state, std::function<void(Phi)> answer)>;

  explicit StateComparison(AskForPhi ask, QObject* parent = nullptr);
  ~StateComparison() override;

  // Unset: nothing is compared any more.
  void choose(std::optional<std::uint64_t> state);
  // The case as it is now.
  void follow(const CaseState& state);

  [[nodiscard]] std::optional<std::uint64_t> state() const { return chosen_; }
  // Of the chosen state; null until it is there.
  [[nodiscard]] const Phi& phi() const { return phi_; }
  // With the present surface, as it was when it last rested; unset until it is known.
  [[nodiscard]] const std::optional<solver::SurfaceAgreement>& agreement() const { return agreement_; }

 signals:
  void changed();

 private:
  void compare();
  void take(const Phi& present, Result<solver::SurfaceAgreement> found);

  AskForPhi ask_;
  std::optional<std::uint64_t> chosen_;
  Phi phi_;
  Phi present_;   // the newest
  Phi compared_;  // with which agreement_ is
  std::optional<solver::SurfaceAgreement> agreement_;
  std::shared_ptr<BackgroundJob> job_;  // while one runs
};

}  // namespace tidemark::engine
