#include "engine/truth_error.h"

#include <cmath>
#include <glm/gtx/component_wise.hpp>
#include <utility>

#include "engine/background_job.h"
#include "engine/display.h"
#include "solver/distance_transform.h"
#include "solver/speed/distance_map.h"

namespace tidemark::engine {
namespace {

constexpr double kSpacings = 3.0;
constexpr double kBeyond = 1.0;  // smallest spacings that the distances reach farther than the colours

TruthError::Map map_of(const Mask& truth) {
  const Geometry& geometry = truth.geometry;
  const double within = truth_error_range_mm(geometry) / glm::compMin(geometry.spacing_mm);
  return solver::distance_map(solver::distance_transform(truth, within + kBeyond), within);
}

}  // namespace

double truth_error_range_mm(const Geometry& geometry) {
  return std::ceil(kSpacings * glm::compMax(geometry.spacing_mm));
}

TruthError::TruthError(Display& display, std::shared_ptr<const Mask> truth, Show show)
    : display_(display), truth_(std::move(truth)), show_(std::move(show)) {
  connect(&display, &Display::changed, this, &TruthError::follow);
}

TruthError::~TruthError() {
  if (job_) job_->abandon();
}

void TruthError::set_truth(std::shared_ptr<const Mask> truth) {
  truth_ = std::move(truth);
  map_.reset();
  if (job_) job_->abandon();
  job_.reset();
  if (std::exchange(shown_, false)) show_(nullptr);
  follow();
}

void TruthError::follow() {
  const bool wanted = truth_ != nullptr && display_.settings().truth_error;
  if (wanted == shown_) return;
  if (wanted && !map_) return make_map();
  shown_ = wanted;
  show_(wanted ? map_ : nullptr);
}

void TruthError::make_map() {
  if (job_) return;
  job_ = BackgroundJob::start(
      this,
      [this, truth = truth_](BackgroundJob& job) {
        job.deliver([this, map = map_of(*truth)] {
          job_.reset();
          map_ = map;
          follow();
        });
      },
      [this](const Error&) { job_.reset(); });
}

}  // namespace tidemark::engine
