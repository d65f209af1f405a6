#include "engine/speed_sampler.h"

namespace tidemark::engine {
namespace {

std::vector<double> values_of(const SpeedSampler::Question& question, const std::stop_token& /*stop*/) {
  const solver::VoxelBox box{question.first, question.size};
  std::vector<double> values(static_cast<std::size_t>(box.voxels()));
  question.speed->evaluate(box, values.data());
  return values;
}

}  // namespace

SpeedSampler::SpeedSampler(QObject* parent)
    : QObject(parent), question_(this, values_of, [this] {
        if (answer() != nullptr) emit answered();
      }) {}

void SpeedSampler::ask(const Question& question) {
  if (question.speed) {
    question_.ask(question);
  } else {
    question_.forget();
  }
}

}  // namespace tidemark::engine
