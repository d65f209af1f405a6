#include "solver/gl/gl_executor.h"

#include <algorithm>
#include <glm/common.hpp>
#include <utility>

namespace tidemark::solver {
namespace {

constexpr std::int64_t kFewestSpare = 64;  // pages

}  // namespace

GlExecutor::GlExecutor(std::shared_ptr<gpu::Device> device, std::shared_ptr<const Volume> source,
                       const Parameters& parameters, const ExecutorOptions& options, Index3 page_shape)
    : ExecutorBase(std::move(source), parameters),
      device_(std::move(device)),
      options_(options),
      layout_(PageLayout(source_->geometry.size, page_shape), device_->capabilities()),
      known_(Field::empty(source_->geometry, band(), page_shape)) {}

Status GlExecutor::make_textures() {
  auto textures = DriveTextures::create(*device_, source_, speed_, options_.threads);
  if (!textures) return pass_on(textures);
  drive_textures_ = std::move(*textures);
  return {};
}

Result<std::int64_t> GlExecutor::capacity_for(
    std::int64_t needed, bool copied, const std::function<std::int64_t(std::int64_t)>& state_bytes) const {
  const auto bytes = [&](std::int64_t pages) { return with_textures(state_bytes(pages)); };
  const std::int64_t least = layout_.rounded_up(needed);
  const std::int64_t all = layout_.layout().page_count() + kFirstPage;  // of the whole volume
  const std::int64_t ample =
      layout_.ample(needed, std::min(needed + std::max(needed / 5, kFewestSpare), all));
  if (ample > least && ample <= layout_.largest_capacity() && bytes(ample) <= options_.memory_budget_bytes) {
    return ample;
  }
  if (bytes(least) <= options_.memory_budget_bytes) return least;
  return fail(ErrorKind::capability, "the surface needs {} pages, {} MB{}, and the memory budget is {} MB",
              least, bytes(least) >> 20, copied ? " while they are copied" : "",
              options_.memory_budget_bytes >> 20);
}

Status GlExecutor::check_budget(std::int64_t textures) const {
  const std::int64_t bytes = memory().state_bytes - drive_textures_.bytes() + textures;
  if (textures <= drive_textures_.bytes() || bytes <= options_.memory_budget_bytes) return {};
  return fail(ErrorKind::capability,
              "the surface with what drives it needs {} MB, and the memory budget is {} MB", bytes >> 20,
              options_.memory_budget_bytes >> 20);
}

Status GlExecutor::check_drive(const SpeedFunction& speed, const Constraints* constraints) const {
  const std::int64_t voxels = memory().resident_pages * layout_.layout().voxels_per_page();
  return check_budget(DriveTextures::least_bytes(voxels, speed, constraints));
}

Status GlExecutor::fill_drive(std::span<const std::int64_t> pages, std::int64_t steps) {
  drive_textures_.want_around(layout_.layout(), pages, steps);
  if (!check_budget(drive_textures_.bytes_wanted())) {
    // What the surface has left behind gives its memory back.
    TIDEMARK_TRY(drive_textures_.release(*device_));
    drive_textures_.want_around(layout_.layout(), pages, steps);
    TIDEMARK_TRY(check_budget(drive_textures_.bytes_wanted()));
  }
  const std::int64_t beside = memory().state_bytes - drive_textures_.bytes();
  TIDEMARK_TRY(drive_textures_.fill(*device_, options_.memory_budget_bytes - beside));
  peak_bytes_ = std::max(peak_bytes_, memory().state_bytes);
  return {};
}

Status GlExecutor::restore(const Field& phi) {
  TIDEMARK_TRY(phi.check_fits(source_->geometry, band()));
  if (phi.layout.page_shape() != layout_.layout().page_shape()) {
    return restore(phi.repaged(phi.band, layout_.layout().page_shape()));
  }
  TIDEMARK_TRY(make_current());
  Field limited = phi;
  if (constraints_ != nullptr && !constraints_->empty()) constrain(limited, *constraints_);
  TIDEMARK_TRY(replace(limited));
  known_.pages = limited.pages;
  return {};
}

// phi goes through the processor, where pages are made that were constant.
Status GlExecutor::set_constraints(std::shared_ptr<const Constraints> constraints) {
  if (constraints != nullptr) {
    TIDEMARK_TRY(check_fits(*constraints));
  }
  TIDEMARK_TRY(check_drive(*speed_, constraints.get()));
  auto phi = snapshot();
  if (!phi) return pass_on(phi);
  const auto former = constraints_;
  Status set = use_constraints(std::move(constraints), *phi);
  if (set) return set;
  // From nothing, so that what was made for the others takes no memory.
  TIDEMARK_TRY(drive_textures_.set_constraints(*device_, nullptr));
  TIDEMARK_TRY(use_constraints(former, *phi));
  return set;
}

Index3 GlExecutor::band_reach() const {
  const PageLayout& layout = layout_.layout();
  const glm::dvec3 page = model_.spacing() * glm::dvec3(layout.page_shape());
  return Index3(glm::min(glm::ceil(band() / page), glm::dvec3(layout.pages())));
}

Status GlExecutor::use_constraints(std::shared_ptr<const Constraints> constraints, const Field& phi) {
  TIDEMARK_TRY(make_current());
  TIDEMARK_TRY(drive_textures_.set_constraints(*device_, constraints.get()));
  constraints_ = std::move(constraints);
  TIDEMARK_TRY(compile_for_drive());
  const std::int64_t peak_resident = peak_resident_;
  const std::int64_t peak_bytes = peak_bytes_;
  TIDEMARK_TRY(restore(phi));
  peak_resident_ = std::max(peak_resident_, peak_resident);
  peak_bytes_ = std::max(peak_bytes_, peak_bytes);
  return {};
}

Status GlExecutor::drive(const Parameters& parameters, std::shared_ptr<const SpeedFunction> given) {
  auto drive = drive_with(parameters, std::move(given));
  if (!drive) return pass_on(drive);
  TIDEMARK_TRY(check_drive(*drive->used, constraints_.get()));
  TIDEMARK_TRY(make_current());
  TIDEMARK_TRY(drive_textures_.set_speed(*device_, drive->used));
  take(std::move(*drive));
  TIDEMARK_TRY(compile_for_drive());
  return wake_all_pages();
}

}  // namespace tidemark::solver
