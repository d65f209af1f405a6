#include "engine/joint_histogram.h"

#include <algorithm>

#include "engine/message_text.h"

namespace tidemark::engine {
namespace {

constexpr std::int64_t kMostSamples = 1'000'000;
constexpr std::int64_t kBetweenLooks = 4096;  // at the stop token

class Places {
 public:
  Places(const Volume& first, const Volume& second)
      : images_{&first, &second}, ranges_{first.common_range(), second.common_range()} {}

  [[nodiscard]] const std::array<std::pair<float, float>, 2>& ranges() const { return ranges_; }
  [[nodiscard]] JointHistogram::Place of(std::int64_t voxel) const {
    JointHistogram::Place place{};
    for (std::size_t image = 0; image < 2; ++image) {
      const auto [low, high] = ranges_[image];
      place[image] = high > low ? (images_[image]->value(voxel) - low) / (high - low) : 0.0F;
    }
    return place;
  }

 private:
  std::array<const Volume*, 2> images_;
  std::array<std::pair<float, float>, 2> ranges_;
};

std::size_t bin_of(float place) {
  const float share = std::clamp(place, 0.0F, 1.0F);  // what lies far beyond fits into no integer
  return std::min<std::size_t>(static_cast<std::size_t>(share * JointHistogram::kBins),
                               JointHistogram::kBins - 1);
}

// Evenly, so that every stroke keeps its share.
std::vector<JointHistogram::Place> points_of(const std::vector<std::int64_t>& stroke, const Places& places) {
  const std::size_t count = std::min(stroke.size(), JointHistogram::kMostPoints);
  std::vector<JointHistogram::Place> points;
  for (std::size_t i = 0; i < count; ++i) points.push_back(places.of(stroke[i * stroke.size() / count]));
  return points;
}

}  // namespace

JointHistogram joint_histogram(const Volume& first, const Volume& second, const solver::Strokes* strokes,
                               const std::stop_token& stop) {
  const Places places(first, second);
  JointHistogram joint;
  joint.ranges = places.ranges();
  joint.counts.assign(static_cast<std::size_t>(JointHistogram::kBins) * JointHistogram::kBins, 0);
  const std::int64_t voxels = first.geometry.voxel_count();
  // Odd, so that it does not follow the columns of common grids.
  const std::int64_t step = std::max<std::int64_t>(1, voxels / kMostSamples) | 1;
  std::int64_t looked = 0;
  for (std::int64_t voxel = 0; voxel < voxels; voxel += step) {
    if (++looked % kBetweenLooks == 0 && stop.stop_requested()) return {};
    const JointHistogram::Place place = places.of(voxel);
    ++joint.counts[bin_of(place[0]) + JointHistogram::kBins * bin_of(place[1])];
  }
  if (strokes == nullptr) return joint;
  joint.inside = points_of(strokes->inside, places);
  joint.outside = points_of(strokes->outside, places);
  return joint;
}

JointCounter::~JointCounter() {
  forget();
}

void JointCounter::forget() {
  if (job_) job_->abandon();
  job_.reset();
  question_ = {};
  answer_.reset();
  problem_.clear();
}

void JointCounter::ask(const Question& question) {
  if (question == question_) return;
  if (question.first != question_.first || question.second != question_.second) answer_.reset();
  question_ = question;
  problem_.clear();
  if (job_) job_->abandon();
  job_ = BackgroundJob::start(
      this,
      [this, question](BackgroundJob& job) {
        const auto second = document::on_grid(*question.second, question.first->geometry);
        if (!second) return job.deliver([this, error = second.error()] { give_up(error); });
        const auto joint = std::make_shared<const JointHistogram>(
            joint_histogram(*question.first, **second, question.strokes.get(), job.stop()));
        job.deliver([this, joint] {
          job_.reset();
          answer_ = joint;
          emit answered();
        });
      },
      [this](const Error& error) { give_up(error); });
}

// Images that do not fit never will; memory may come back.
void JointCounter::give_up(const Error& error) {
  job_.reset();
  if (error.kind != ErrorKind::usage) question_ = {};
  answer_.reset();
  problem_ = message_text(error);
  emit answered();
}

}  // namespace tidemark::engine
