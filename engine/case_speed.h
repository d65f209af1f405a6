// Drives of a case that take a while to make: speed functions and the smoothed source.
// They are made in the background and handed over; the level set goes on meanwhile with what it has.
#pragma once

#include <functional>
#include <optional>

#include "document/case.h"
#include "engine/speed_maker.h"

namespace tidemark::engine {

// Belongs to the engine's thread.
class CaseSpeed {
 public:
  // Called on another thread: has take() called on the engine's.
  using Deliver = std::function<void(const SpeedOrigin&, SpeedMaker::Made)>;

  // The level set's source is to be smoothed by that many mm.
  void smooth(double sigma_mm) { smoothing_ = sigma_mm; }
  // By how much it is being smoothed; none: it is as it should be.
  [[nodiscard]] std::optional<double> smoothing() const { return smoothing_; }
  void give_up_smoothing() { smoothing_.reset(); }

  // Has made what is missing, unless it is on its way. To be called after every command.
  void follow(const document::Case& document, const SpeedMaker::Report& report, const Deliver& deliver);
  // Hands over what was made. Returns whether it was wanted.
  Result<bool> take(document::Case& document, const SpeedOrigin& origin, const SpeedMaker::Made& made);

  [[nodiscard]] bool waits() const { return waits_; }
  // While another kind of function is on its way or cannot be had, the surface does not move by the one
  // before.
  [[nodiscard]] bool holds_steps(const document::Case& document) const;
  // One that could not be had is tried again.
  void try_again();
  void give_up() { maker_.give_up(); }

 private:
  std::optional<double> smoothing_;
  SpeedOrigin made_;                 // of the function that drives the surface
  std::optional<SpeedOrigin> wish_;  // on its way, or cannot be had
  bool waits_ = false;               // the former
  // With it the wish could not be had: the raw form of the tent cannot be joined.
  solver::DataForm refused_form_ = solver::DataForm::clamped;
  SpeedMaker maker_;
};

}  // namespace tidemark::engine
