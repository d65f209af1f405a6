#include "engine/speed_sampler.h"

#include <utility>

namespace tidemark::engine {

SpeedSampler::~SpeedSampler() {
  if (job_) job_->abandon();
}

void SpeedSampler::ask(const Question& question) {
  if (question == question_) return;
  question_ = question;
  answer_.reset();
  if (!job_) start();
}

void SpeedSampler::start() {
  if (!question_.speed) return;
  job_ = BackgroundJob::start(
      this,
      [this, question = question_](BackgroundJob& job) {
        const solver::VoxelBox box{question.first, question.size};
        std::vector<double> values(static_cast<std::size_t>(box.voxels()));
        question.speed->evaluate(box, values.data());
        job.deliver(
            [this, question, values = std::move(values)]() mutable { take(question, std::move(values)); });
      },
      [this](const Error&) { job_.reset(); });
}

void SpeedSampler::take(const Question& question, std::vector<double> values) {
  job_.reset();
  if (question != question_) return start();
  answer_ = std::move(values);
  emit answered();
}

}  // namespace tidemark::engine
