// Replacing and painting phi in the compute executor.
#include <algorithm>
#include <glm/common.hpp>
#include <utility>

#include "solver/compute/compute_executor.h"

namespace tidemark::solver {

Status ComputeExecutor::replace(const Field& phi) {
  auto capacity = capacity_for(phi.pages.stored() + kFirstPage, false,
                               [&](std::int64_t pages) { return PageMemory::bytes_for(layout_, pages); });
  if (!capacity) return pass_on(capacity);
  auto memory = PageMemory::create(*device_, layout_, phi, *capacity);
  if (!memory) return pass_on(memory);
  memory_ = std::move(*memory);
  current_ = 0;
  steps_in_window_ = 0;
  rests_ = false;
  peak_resident_ = peak_bytes_ = 0;
  return activate_pages(NoRoom::waits);
}

Status ComputeExecutor::wake_all_pages() {
  begin_window(true);
  TIDEMARK_TRY(read_control());
  return device_->check("waking all pages");
}

// Orders the drawing of a sphere, or only the count of the pages that must be made for it.
void ComputeExecutor::order_sphere(const Sphere& sphere, Brush brush, bool only_count) {
  const Geometry& geometry = source_->geometry;
  const glm::dvec3 centre = geometry.to_voxel(sphere.centre_mm);
  const double unit = model_.smallest_spacing_mm();
  const glm::dvec3 reach = (sphere.radius_mm + band() * unit) / geometry.spacing_mm;
  const glm::dvec3 last_voxel(geometry.size - Index3(1));
  const Index3 shape = layout_.layout().page_shape();
  const Index3 first = Index3(glm::clamp(glm::floor(centre - reach), glm::dvec3(0), last_voxel)) / shape;
  const Index3 last = Index3(glm::clamp(glm::ceil(centre + reach), glm::dvec3(0), last_voxel)) / shape;

  memory_.bind();
  paint_.use();
  set_layout(paint_);
  paint_.set("first_page", glm::ivec3(first));
  paint_.set("centre", glm::vec3(centre));
  paint_.set("radius", static_cast<float>(sphere.radius_mm / unit));
  paint_.set("spacing", glm::vec3(geometry.spacing_mm / unit));
  paint_.set("band", static_cast<float>(band()));
  paint_.set("erase", brush == Brush::erase ? 1 : 0);
  paint_.set("only_count", only_count ? 1 : 0);
  drive_textures_.set_constraint_uniforms(paint_, 1);
  memory_.field().phi(current_).bind_image(0, true);
  memory_.field().phi(1 - current_).bind_image(1, true);
  gpu::dispatch(glm::ivec3(last - first + Index3(1)));
  gpu::finish_writes();
}

Status ComputeExecutor::paint(const Sphere& sphere, Brush brush) {
  TIDEMARK_TRY(device_->make_current());
  // A sphere is drawn whole or not at all: its pages find room first.
  TIDEMARK_TRY(read_control());
  control_.pages_wanted = 0;
  memory_.write_control(control_);
  order_sphere(sphere, brush, true);
  TIDEMARK_TRY(read_control());
  TIDEMARK_TRY(device_->check("measuring a sphere"));
  const std::int64_t missing = control_.pages_wanted - control_.free_pages();
  if (missing > 0) {
    TIDEMARK_TRY(grow(missing));
  }
  control_.free_tail_ready = control_.free_tail;
  memory_.write_control(control_);
  order_sphere(sphere, brush, false);
  begin_window(false);
  return activate_pages(NoRoom::waits);
}

}  // namespace tidemark::solver
