// Replacing and painting phi, and what follows from what drives it, in the stream executor.
#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

#include "core/index_walk.h"
#include "solver/stream/pages_around.h"
#include "solver/stream/stream_executor.h"

namespace tidemark::solver {
namespace {

// The pages that a sphere changes, and how.
struct PaintJob {
  const Geometry& geometry;
  const PageLayout& layout;
  Sphere sphere;
  Brush brush;
  glm::dvec3 centre;  // voxels
  double unit;        // the smallest spacing, mm
  float band;
  const Constraints* constraints;  // null: none

  // What phi, which keeps to walls and anchors, is combined with in the voxels of a page.
  [[nodiscard]] std::vector<float> values(Index3 page) const {
    std::vector<float> values;
    const Index3 first = page * layout.page_shape();
    for (std::int64_t y = 0; y < layout.page_shape().y; ++y) {
      for (std::int64_t x = 0; x < layout.page_shape().x; ++x) {
        const glm::dvec3 offset = (glm::dvec3(first + Index3(x, y, 0)) - centre) * geometry.spacing_mm;
        const double distance = (sphere.radius_mm - glm::length(offset)) / unit;
        const float d = std::clamp(static_cast<float>(distance), -band, band);
        values.push_back(limited(brush == Brush::add ? d : -d, first + Index3(x, y, 0)));
      }
    }
    return values;
  }
  // The value that changes nothing, and the one that nothing withstands.
  [[nodiscard]] float neutral() const { return brush == Brush::add ? -band : band; }

  [[nodiscard]] Index3 first_page() const { return page_at(glm::floor(centre - reach())); }
  [[nodiscard]] Index3 last_page() const { return page_at(glm::ceil(centre + reach())); }

 private:
  [[nodiscard]] float limited(float value, Index3 voxel) const {
    if (constraints == nullptr || voxel.x >= geometry.size.x || voxel.y >= geometry.size.y) return value;
    const Constraint what = constraints->at(voxel);
    return (brush == Brush::add ? is_upper(what) : is_lower(what)) ? solver::limited(what, value) : value;
  }
  [[nodiscard]] glm::dvec3 reach() const {
    return (sphere.radius_mm + static_cast<double>(band) * unit) / geometry.spacing_mm;
  }
  [[nodiscard]] Index3 page_at(glm::dvec3 voxel) const {
    return Index3(glm::clamp(voxel, glm::dvec3(0), glm::dvec3(geometry.size - Index3(1)))) /
           layout.page_shape();
  }
};

bool all_equal(const std::vector<float>& values, float value) {
  return std::all_of(values.begin(), values.end(), [&](float v) { return v == value; });
}

}  // namespace

Status StreamExecutor::replace(const Field& phi) {
  auto capacity = capacity_for(phi.pages.stored() + kFirstPage, false,
                               [&](std::int64_t pages) { return state_bytes(pages); });
  if (!capacity) return pass_on(capacity);
  auto memory = PhysicalMemory::create(*device_, layout_, *capacity, static_cast<float>(band()));
  if (!memory) return pass_on(memory);
  memory->field().upload(phi.pages);
  memory_ = std::move(*memory);

  pages_ = PagedMemory<3>(layout_.layout(), kUnlimited);
  infos_ = pages_.attach<PageInfo, 1>();
  viewed_changes_ = filled_changes_ = -1;
  for (std::int64_t page = 0; page < pages_.layout().page_count(); ++page) {
    if (phi.pages.kind(page) == Field::Kind::inside) pages_.set_static(page, true);
  }
  for (const std::int64_t page : phi.pages.stored_pages()) {
    const Result<PhysicalPage> made = pages_.make_resident(page);
    TIDEMARK_TRY(made);
    info(*made) = PageInfo();
  }
  for (auto& pages_to_fill : new_) pages_to_fill.clear();
  current_ = 0;
  restart_watch(layout_.layout().voxels_per_page());
  active_list_is_stale_ = true;
  peak_resident_ = pages_.table().resident();
  peak_bytes_ = with_textures(state_bytes(memory_.capacity()));
  TIDEMARK_TRY(activate_pages(resident_pages(), NoRoom::waits));
  return rebuild_active_list();
}

Result<Field> StreamExecutor::snapshot() const {
  TIDEMARK_TRY(device_->make_current());
  auto physical = memory_.field().download(current_);
  if (!physical) return pass_on(physical);
  Field phi = known_;
  update(phi, pages_.table().entries(), *physical);
  return known_ = std::move(phi);
}

Status StreamExecutor::make_current() const {
  TIDEMARK_TRY(device_->make_current());
  gpu::begin_exact_drawing();
  return {};
}

Status StreamExecutor::compile_for_drive() {
  return passes_.compile_step(*device_, active_geometry_, drive_textures_, model_);
}

Status StreamExecutor::wake_all_pages() {
  filled_changes_ = -1;
  restart_watch(layout_.layout().voxels_per_page());
  begin_window();
  pages_.for_each_resident([&](PhysicalPage page) { wake(page); });
  peak_bytes_ = std::max(peak_bytes_, with_textures(state_bytes(memory_.capacity())));
  return rebuild_active_list();
}

// Sorts the pages that the sphere may touch by what it does to them.
StreamExecutor::PaintPlan StreamExecutor::plan_paint(const Sphere& sphere, Brush brush) const {
  const PageLayout& layout = pages_.layout();
  const PaintJob job{source_->geometry,
                     layout,
                     sphere,
                     brush,
                     source_->geometry.to_voxel(sphere.centre_mm),
                     model_.smallest_spacing_mm(),
                     static_cast<float>(band()),
                     constraints_.get()};
  PaintPlan plan;
  for_each_index(job.first_page(), job.last_page() + Index3(1), [&](Index3 coordinates) {
    const std::int64_t page = layout.page_number(coordinates);
    const PhysicalPage physical = pages_.physical(page);
    const std::vector<float> values = job.values(coordinates);
    if (all_equal(values, job.neutral())) return;
    if (is_static_page(physical)) {
      const float constant = physical == kInsidePage ? job.band : -job.band;
      if (constant != job.neutral()) return;  // there is nothing to add or to erase
      if (all_equal(values, -job.neutral())) return plan.to_flip.push_back(page);
      ++plan.to_allocate;
    }
    plan.to_draw.push_back(page);
    plan.values.insert(plan.values.end(), values.begin(), values.end());
  });
  return plan;
}

Status StreamExecutor::paint(const Sphere& sphere, Brush brush) {
  TIDEMARK_TRY(make_current());
  const PaintPlan plan = plan_paint(sphere, brush);
  // Every page that is drawn into finds room, so that a sphere is drawn whole or not at all.
  TIDEMARK_TRY(make_room(plan.to_allocate));
  std::vector<PhysicalPage> pages;
  for (const std::int64_t page : plan.to_draw) {
    if (is_static_page(pages_.physical(page))) {
      TIDEMARK_TRY(make_resident(page));
    }
    pages.push_back(pages_.physical(page));
  }
  TIDEMARK_TRY(fill_new_pages());
  if (!pages.empty()) {
    TIDEMARK_TRY(special_geometry_.describe(*device_, pages_, pages));
    const auto blending = brush == Brush::add ? gpu::Blending::largest : gpu::Blending::smallest;
    TIDEMARK_TRY(passes_.paint(*device_, special_geometry_, memory_, plan.values, blending));
  }
  for (const PhysicalPage page : pages) {
    wake_around(page);
    info(page).constant_steps = 0;
  }
  for (const std::int64_t page : plan.to_flip) pages_.set_static(page, brush == Brush::add);
  for (const std::int64_t page : plan.to_flip) {
    all_within(Index3(1), pages_.layout().page_coordinates(page), [&](Index3 coordinates) {
      const PhysicalPage other = pages_.physical(coordinates);
      if (other >= kFirstPage) pages.push_back(other);
      return true;
    });
  }
  std::sort(pages.begin(), pages.end());
  pages.erase(std::unique(pages.begin(), pages.end()), pages.end());
  active_list_is_stale_ = true;
  restart_watch(layout_.layout().voxels_per_page());
  begin_window();
  TIDEMARK_TRY(activate_pages(needs_activation_ ? resident_pages() : std::move(pages), NoRoom::waits));
  return rebuild_active_list();
}

}  // namespace tidemark::solver
