#include "engine/truth_comparison.h"

#include <mutex>
#include <utility>

#include "solver/distance_transform.h"

namespace tidemark::engine {
namespace {

constexpr int kComparisonRest = 9;  // times as long as a comparison takes
constexpr double kBand = 2.0;       // nothing but where the surface lies is taken from it

}  // namespace

// Made once, by who first asks, which is never the thread of the user interface.
class TruthSurface {
 public:
  explicit TruthSurface(std::shared_ptr<const BitMask> mask) : mask_(std::move(mask)) {}

  [[nodiscard]] const std::shared_ptr<const BitMask>& mask() const { return mask_; }
  [[nodiscard]] const solver::MeasuredSurface& surface() const {
    std::call_once(once_, [this] {
      // Nothing can stop it.
      surface_.emplace(*solver::MeasuredSurface::of(solver::distance_transform(inside_of(*mask_), kBand)));
    });
    return *surface_;
  }

 private:
  std::shared_ptr<const BitMask> mask_;
  mutable std::once_flag once_;
  mutable std::optional<solver::MeasuredSurface> surface_;
};

TruthComparison::TruthComparison(QObject* parent)
    : QObject(parent),
      question_(
          this, &TruthComparison::compare, [this] { emit answered(); }, kComparisonRest) {}

void TruthComparison::ask(const std::shared_ptr<const BitMask>& truth,
                          std::shared_ptr<const solver::Field> phi) {
  if (!truth_ || truth_->mask() != truth) {
    question_.forget();
    truth_ = std::make_shared<const TruthSurface>(truth);
  }
  question_.ask({truth_, std::move(phi)});
}

void TruthComparison::forget() {
  question_.forget();
}

std::optional<solver::SurfaceDistance> TruthComparison::distance() const {
  return question_.answer() ? question_.answer()->answer : std::nullopt;
}

TruthComparison::Answer TruthComparison::compare(const Question& question, const std::stop_token& stop) {
  const Progress progress{nullptr, stop};
  const auto surface = solver::MeasuredSurface::of(*question.phi, progress);
  if (!surface) return std::nullopt;
  const auto distance = surface->distance_to(question.truth->surface(), progress);
  return distance ? *distance : std::nullopt;
}

}  // namespace tidemark::engine
