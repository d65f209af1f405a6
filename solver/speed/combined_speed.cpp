#include "solver/speed/combined_speed.h"

#include <algorithm>

#include "solver/speed/tent_speed.h"

namespace tidemark::solver {

CombinedSpeed::CombinedSpeed(std::vector<std::shared_ptr<const SpeedFunction>> functions, Combine combine)
    : functions_(std::move(functions)), combine_(combine) {}

void CombinedSpeed::join(Evaluate method, const VoxelBox& box, double* speed) const {
  const auto count = static_cast<std::size_t>(box.voxels());
  ((*functions_.front()).*method)(box, speed);
  std::vector<double> other(count);
  for (std::size_t f = 1; f < functions_.size(); ++f) {
    ((*functions_[f]).*method)(box, other.data());
    if (combine_ == Combine::least) {
      std::transform(speed, speed + count, other.data(), speed,
                     [](double a, double b) { return std::min(a, b); });
    } else {
      // Of p = (D + 1) / 2, again as D.
      std::transform(speed, speed + count, other.data(), speed,
                     [](double a, double b) { return 0.5 * (a + 1.0) * (b + 1.0) - 1.0; });
    }
  }
}

bool CombinedSpeed::advects() const {
  return std::any_of(functions_.begin(), functions_.end(), [](const auto& f) { return f->advects(); });
}

void CombinedSpeed::evaluate_advection(const VoxelBox& box, glm::vec3* velocity) const {
  const auto count = static_cast<std::size_t>(box.voxels());
  std::fill_n(velocity, count, glm::vec3(0.0F));
  std::vector<glm::vec3> one(count);
  for (const auto& function : functions_) {
    if (!function->advects()) continue;
    function->evaluate_advection(box, one.data());
    std::transform(velocity, velocity + count, one.data(), velocity,
                   [](const glm::vec3& a, const glm::vec3& b) { return a + b; });
  }
}

double CombinedSpeed::fastest_advection() const {
  double sum = 0.0;
  for (const auto& function : functions_) sum += function->fastest_advection();
  return sum;
}

bool CombinedSpeed::has_doubt() const {
  return std::any_of(functions_.begin(), functions_.end(), [](const auto& f) { return f->has_doubt(); });
}

void CombinedSpeed::evaluate_doubt(const VoxelBox& box, double* doubt) const {
  const auto count = static_cast<std::size_t>(box.voxels());
  std::fill_n(doubt, count, 0.0);
  std::vector<double> one(count);
  for (const auto& function : functions_) {
    if (!function->has_doubt()) continue;
    function->evaluate_doubt(box, one.data());
    std::transform(doubt, doubt + count, one.data(), doubt,
                   [](double a, double b) { return std::max(a, b); });
  }
}

bool CombinedSpeed::follows_surface() const {
  return std::any_of(functions_.begin(), functions_.end(),
                     [](const auto& f) { return f->follows_surface(); });
}

std::shared_ptr<const SpeedFunction> CombinedSpeed::following(const Field& phi) const {
  std::vector<std::shared_ptr<const SpeedFunction>> next = functions_;
  bool changed = false;
  for (auto& function : next) {
    if (!function->follows_surface()) continue;
    if (auto successor = function->following(phi)) {
      function = std::move(successor);
      changed = true;
    }
  }
  if (!changed) return nullptr;
  return std::make_shared<CombinedSpeed>(std::move(next), combine_);
}

std::shared_ptr<const CombinedSpeed> CombinedSpeed::with_tents(const std::shared_ptr<const Volume>& source,
                                                               const Parameters& parameters) const {
  std::vector<std::shared_ptr<const SpeedFunction>> functions = functions_;
  for (auto& function : functions) {
    if (function->tent() != nullptr) function = std::make_shared<TentSpeed>(source, parameters);
  }
  return std::make_shared<CombinedSpeed>(std::move(functions), combine_);
}

}  // namespace tidemark::solver
