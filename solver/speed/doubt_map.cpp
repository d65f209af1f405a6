#include "solver/speed/doubt_map.h"

#include <cmath>
#include <utility>

namespace tidemark::solver {
namespace {

class DoubtMap final : public SpeedFunction {
 public:
  explicit DoubtMap(std::shared_ptr<const SpeedFunction> function) : function_(std::move(function)) {}

  void evaluate(const VoxelBox& box, double* doubt) const override { function_->evaluate_doubt(box, doubt); }

 private:
  std::shared_ptr<const SpeedFunction> function_;
};

}  // namespace

double entropy(double p) {
  const auto share = [](double q) { return q > 0.0 ? -q * std::log2(q) : 0.0; };
  return share(p) + share(1.0 - p);
}

std::shared_ptr<const SpeedFunction> doubt_map(std::shared_ptr<const SpeedFunction> function) {
  if (function == nullptr || !function->has_doubt()) return nullptr;
  return std::make_shared<DoubtMap>(std::move(function));
}

}  // namespace tidemark::solver
