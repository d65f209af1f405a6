#include "engine/state_comparison.h"

#include <utility>

#include "engine/background_job.h"

namespace tidemark::engine {

StateComparison::StateComparison(AskForPhi ask, QObject* parent) : QObject(parent), ask_(std::move(ask)) {}

StateComparison::~StateComparison() {
  if (job_) job_->abandon();
}

void StateComparison::choose(std::optional<std::uint64_t> state) {
  if (state == chosen_) return;
  chosen_ = state;
  phi_.reset();
  compared_.reset();
  agreement_.reset();
  if (job_) std::exchange(job_, nullptr)->abandon();
  emit changed();
  if (!chosen_) return;
  ask_(*chosen_, [this, asked = *chosen_](Phi phi) {
    if (chosen_ != asked) return;
    if (!phi) return choose(std::nullopt);
    phi_ = std::move(phi);
    emit changed();
    compare();
  });
}

void StateComparison::follow(const CaseState& state) {
  if (chosen_ && !find_row(*state.history, *chosen_)) return choose(std::nullopt);  // it was forgotten
  if (state.playing) return;
  present_ = state.phi;
  compare();
}

void StateComparison::compare() {
  if (!phi_ || !present_ || present_ == compared_ || job_) return;
  job_ = BackgroundJob::start(
      this,
      [this, present = present_, other = phi_](BackgroundJob& job) {
        auto found = solver::agreement(*present, *other, {nullptr, job.stop()});
        job.deliver([this, present, found = std::move(found)]() mutable { take(present, std::move(found)); });
      },
      [this, present = present_](const Error& error) { take(present, tl::unexpected<Error>(error)); });
}

// What could not be computed, for lack of memory, is not known.
void StateComparison::take(const Phi& present, Result<solver::SurfaceAgreement> found) {
  job_.reset();
  compared_ = present;
  agreement_ = found ? std::optional(*found) : std::nullopt;
  emit changed();
  compare();
}

}  // namespace tidemark::engine
