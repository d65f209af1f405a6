// phi where a picture needs it: at voxels and between them, straight from pages in the processor's memory.
#pragma once

#include <cstdint>
#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "solver/field.h"
#include "solver/host/page_view.h"

namespace tidemark::renderer {

// The state of a page of V_P, numbered as in resources/shaders/render/page_state.glsl.
enum class PageState : std::uint8_t { outside, inside, resident, quiet, new_page };

class PhiPages {
 public:
  // Page sides are powers of two. All outside at first.
  PhiPages(const PageLayout& layout, double band);

  // The pages of a copy, which is kept, or of an executor's memory, which must stay as it is until the next
  // call. `quiet`: virtual pages that are not computed at present; without them state() stays as it was.
  void show(std::shared_ptr<const solver::Field> phi, std::span<const std::int64_t> quiet);
  void show(const solver::PageView& view, const std::optional<std::vector<std::int64_t>>& quiet);

  [[nodiscard]] const PageLayout& layout() const { return layout_; }
  [[nodiscard]] float band() const { return band_; }

  // A page's number in V_P, and back, for coordinates inside of it.
  [[nodiscard]] int page_number(glm::ivec3 page) const { return number_in(pages_, page); }
  [[nodiscard]] glm::ivec3 page_of(glm::ivec3 voxel) const {
    return {voxel.x >> shift_.x, voxel.y >> shift_.y, voxel.z >> shift_.z};
  }
  [[nodiscard]] glm::ivec3 page_grid() const { return pages_; }
  [[nodiscard]] glm::ivec3 page_shape() const { return mask_ + 1; }
  [[nodiscard]] bool is_resident(int page) const { return !is_static(values_of(page)); }
  // Of a page that is not resident.
  [[nodiscard]] bool is_inside(int page) const { return values_of(page) == inside_.data(); }
  [[nodiscard]] PageState state(int page) const { return states_[static_cast<std::size_t>(page)]; }
  // In ascending order.
  [[nodiscard]] std::vector<std::int64_t> resident_pages() const;
  // Counts what was shown, and says whether a page is another one since.
  [[nodiscard]] std::uint64_t revision() const { return revision_; }
  [[nodiscard]] bool has_changed_since(int page, std::uint64_t revision) const {
    return changed_[static_cast<std::size_t>(page)] > revision;
  }

  // Clamped to the volume.
  [[nodiscard]] float at(glm::ivec3 voxel) const {
    const glm::ivec3 v = glm::clamp(voxel, glm::ivec3(0), size_ - 1);
    return values_of(page_number(page_of(v)))[offset_in_page(v)];
  }
  // Trilinear; voxel coordinates, integers at voxel centres. Beyond the volume as at its border.
  [[nodiscard]] float between(glm::vec3 position) const;
  // d phi / d voxel, from differences over a voxel to each side.
  [[nodiscard]] glm::vec3 slope(glm::vec3 position) const;

 private:
  [[nodiscard]] const float* values_of(int page) const { return values_[static_cast<std::size_t>(page)]; }
  [[nodiscard]] bool is_static(const float* page) const {
    return page == outside_.data() || page == inside_.data();
  }
  [[nodiscard]] int offset_in_page(glm::ivec3 voxel) const {
    return (voxel.x & mask_.x) + (((voxel.y & mask_.y) + ((voxel.z & mask_.z) << shift_.y)) << shift_.x);
  }
  void begin(double band);
  void mark(std::span<const std::int64_t> quiet);

  PageLayout layout_;
  glm::ivec3 size_{0};   // voxels
  glm::ivec3 pages_{0};  // V_P's
  glm::ivec3 shift_{0};  // log2 of a page's sides
  glm::ivec3 mask_{0};   // sides - 1
  float band_ = 0.0F;
  std::vector<float> outside_;  // the two static pages
  std::vector<float> inside_;
  std::vector<const float*> values_;  // of each virtual page
  std::vector<PageState> states_;
  std::vector<bool> was_resident_;
  std::shared_ptr<const solver::Field> copy_;
  // The memory that was shown last, and when; null: a copy was.
  const solver::PagedMemory<3>* memory_ = nullptr;
  solver::ChangedPages::Moment seen_ = 0;
  std::uint64_t revision_ = 0;
  std::vector<std::uint64_t> changed_;  // by virtual page: the first revision with what it has now
};

}  // namespace tidemark::renderer
