#include "solver/reference/reference_executor.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/index_walk.h"
#include "solver/reference/gather-inl.h"
#include "solver/speed/update-inl.h"

namespace tidemark::solver {
namespace {

using HWY_NAMESPACE::Stencil;

Stencil<double> gather(const std::vector<double>& phi, const Geometry& geometry, Index3 v) {
  return HWY_NAMESPACE::gather([&](Index3 n) { return phi[static_cast<std::size_t>(geometry.offset(n))]; },
                               geometry.size, v);
}

}  // namespace

ReferenceExecutor::ReferenceExecutor(std::shared_ptr<const Volume> source, const Parameters& parameters,
                                     Index3 page_shape)
    : ExecutorBase(std::move(source), parameters),
      layout_(source_->geometry.size, page_shape),
      speed_values_(static_cast<std::size_t>(source_->geometry.voxel_count())) {
  evaluate_speed();
  set_values(std::vector<double>(speed_values_.size(), -model_.band()));
}

void ReferenceExecutor::evaluate_speed() {
  const VoxelBox whole{Index3(0), source_->geometry.size};
  speed_->evaluate(whole, speed_values_.data());
  advection_.clear();
  if (!speed_->advects()) return;
  advection_.resize(speed_values_.size());
  speed_->evaluate_advection(whole, advection_.data());
}

double ReferenceExecutor::constrained(Index3 voxel, double phi) const {
  return constraints_ == nullptr ? phi : limited(constraints_->at(voxel), phi);
}

void ReferenceExecutor::constrain() {
  if (constraints_ == nullptr) return;
  const Geometry& geometry = source_->geometry;
  for_each_index(Index3(0), geometry.size, [&](Index3 voxel) {
    double& phi = phi_[static_cast<std::size_t>(geometry.offset(voxel))];
    phi = constrained(voxel, phi);
  });
}

void ReferenceExecutor::set_values(std::vector<double> phi) {
  phi_ = std::move(phi);
  constrain();
  next_.resize(phi_.size());
  begin_window();
}

void ReferenceExecutor::begin_window() {
  contents_.assign(static_cast<std::size_t>(layout_.page_count()), {});
  rests_.resize(contents_.size());
  restart_watch(layout_.voxels_per_page());
}

// Ends the window when this step does, and says whether it did.
bool ReferenceExecutor::finish_window() {
  if (++steps_in_window_ < kConvergenceWindow) return false;
  for (std::size_t page = 0; page < contents_.size(); ++page) {
    contents_[page].samples = kMotionSamples;
    watch_.add_page(contents_[page], rests_[page]);
  }
  watch_.end_window();
  contents_.assign(contents_.size(), {});
  steps_in_window_ = 0;
  return true;
}

// Adds a voxel to its page's sample.
void ReferenceExecutor::measure(Index3 voxel, double phi, double near) {
  PageContent& page = contents_[static_cast<std::size_t>(layout_.translate(voxel).page)];
  page.content += std::clamp(phi, -near, near) + near;
  if (std::abs(phi) <= near) page.near_voxels += 1.0;
}

Result<std::vector<std::int64_t>> ReferenceExecutor::moving_pages() const {
  std::vector<std::int64_t> pages;
  for (std::size_t page = 0; page < rests_.size(); ++page) {
    if (watch_.is_moving(rests_[page])) pages.push_back(static_cast<std::int64_t>(page));
  }
  return pages;
}

Status ReferenceExecutor::restore(const Field& phi) {
  if (phi.geometry.size != source_->geometry.size) {
    return fail(ErrorKind::usage, "phi and the volume differ in size");
  }
  const std::vector<float> values = phi.dense();
  set_values({values.begin(), values.end()});
  return {};
}

Result<Field> ReferenceExecutor::snapshot() const {
  const std::vector<float> values(phi_.begin(), phi_.end());
  return Field::from_dense(source_->geometry, values, model_.band(), layout_.page_shape());
}

Status ReferenceExecutor::paint(const Sphere& sphere, Brush brush) {
  const Geometry& geometry = source_->geometry;
  for_each_index(Index3(0), geometry.size, [&](Index3 voxel) {
    const double distance_mm = sphere.radius_mm - glm::distance(geometry.to_patient(voxel), sphere.centre_mm);
    const double d = std::clamp(distance_mm / model_.smallest_spacing_mm(), -model_.band(), model_.band());
    double& phi = phi_[static_cast<std::size_t>(geometry.offset(voxel))];
    phi = brush == Brush::add ? std::max(phi, d) : std::min(phi, -d);
  });
  constrain();
  begin_window();
  return {};
}

Status ReferenceExecutor::drive(const Parameters& parameters, std::shared_ptr<const SpeedFunction> given) {
  auto drive = drive_with(parameters, std::move(given));
  if (!drive) return pass_on(drive);
  take(std::move(*drive));
  evaluate_speed();
  begin_window();
  return {};
}

Status ReferenceExecutor::set_constraints(std::shared_ptr<const Constraints> constraints) {
  if (constraints != nullptr) {
    TIDEMARK_TRY(check_fits(*constraints));
  }
  constraints_ = std::move(constraints);
  set_values(std::move(phi_));
  return {};
}

template <bool kPaper>
void ReferenceExecutor::step() {
  const Geometry& geometry = source_->geometry;
  const StepConstants<double> constants = model_.constants<double>();
  const auto update = HWY_NAMESPACE::update_constants<double>(constants);
  const bool is_measured = next_step_is_measured();
  for_each_index(Index3(0), geometry.size, [&](Index3 voxel) {
    const auto i = static_cast<std::size_t>(geometry.offset(voxel));
    const Stencil<double> stencil = gather(phi_, geometry, voxel);
    const auto d = HWY_NAMESPACE::differences<true, double>(stencil, update.inverse_spacing);
    const double data = constants.time_step * constants.data_weight * speed_values_[i];
    double advected = 0.0;
    if (!advection_.empty()) {
      const glm::dvec3 per_step = constants.time_step * glm::dvec3(advection_[i]);
      advected = HWY_NAMESPACE::advected<double>(
          stencil, {per_step.x * update.inverse_spacing[0], per_step.y * update.inverse_spacing[1],
                    per_step.z * update.inverse_spacing[2]});
    }
    next_[i] = constrained(voxel, HWY_NAMESPACE::updated_phi<kPaper, double>(d, data, update, advected));
    if (is_measured) measure(voxel, next_[i], constants.near);
  });
  phi_.swap(next_);
}

Result<AdvanceReport> ReferenceExecutor::advance(const Advance& run) {
  return run_steps(run, [this](AdvanceReport& report) -> Result<bool> {
    if (parameters().scheme == Scheme::paper) {
      step<true>();
    } else {
      step<false>();
    }
    report.voxel_updates += static_cast<std::int64_t>(phi_.size());
    return finish_window();
  });
}

MemoryReport ReferenceExecutor::memory() const {
  MemoryReport report;
  report.resident_pages = report.peak_resident_pages = layout_.page_count();
  report.state_bytes = report.peak_state_bytes =
      static_cast<std::int64_t>((phi_.size() + next_.size()) * sizeof(double));
  report.source_bytes = static_cast<std::int64_t>(speed_values_.size() * sizeof(double) +
                                                  advection_.size() * sizeof(glm::vec3));
  report.page_shape = layout_.page_shape();
  return report;
}

Status ReferenceExecutor::validate() const {
  for (const double phi : phi_) {
    if (!std::isfinite(phi)) return fail(ErrorKind::internal, "phi is not finite");
    if (std::abs(phi) > model_.band()) return fail(ErrorKind::internal, "phi leaves the band");
  }
  return {};
}

}  // namespace tidemark::solver
