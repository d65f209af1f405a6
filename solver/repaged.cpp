// phi in pages of another shape, page by page: a volume of floats would be far larger than all pages.
#include <algorithm>
#include <glm/common.hpp>
#include <optional>
#include <vector>

#include "core/index_walk.h"
#include "solver/field.h"

namespace tidemark::solver {
namespace {

class Repager {
 public:
  Repager(const Field& from, Field& to)
      : from_(from),
        to_(to),
        old_limit_(static_cast<float>(from.band)),
        new_limit_(static_cast<float>(to.band)),
        values_(static_cast<std::size_t>(to.layout.voxels_per_page())) {}

  void make(std::int64_t page) {
    const Index3 first = to_.layout.first_voxel(page);
    const Index3 end = first + to_.layout.valid_shape(page);
    const Index3 shape = from_.layout.page_shape();
    const Index3 first_source = first / shape;
    const Index3 end_source = (end + shape - Index3(1)) / shape;
    if (const auto constant = constant_in(first_source, end_source)) {
      to_.pages.set_constant(page, *constant);
      return;
    }
    std::fill(values_.begin(), values_.end(), -new_limit_);
    for_each_index(first_source, end_source, [&](Index3 source) { copy(source, first, end); });
    to_.store_page(page, values_);
  }

 private:
  [[nodiscard]] Field::Kind kind_at(Index3 source) const {
    return from_.pages.kind(from_.layout.page_number(source));
  }

  // What all these pages are; none when one is stored or they differ.
  [[nodiscard]] std::optional<Field::Kind> constant_in(Index3 first, Index3 end) const {
    const Field::Kind one = kind_at(first);
    const bool same = one != Field::Kind::stored &&
                      all_indices(first, end, [&](Index3 source) { return kind_at(source) == one; });
    return same ? std::optional(one) : std::nullopt;
  }

  // The voxels of a page of the source that lie in the box of the page that is made.
  void copy(Index3 source, Index3 first, Index3 end) {
    const float* const values = from_.pages.values(from_.layout.page_number(source));
    const Index3 old_shape = from_.layout.page_shape();
    const Index3 new_shape = to_.layout.page_shape();
    const Index3 corner = source * old_shape;
    const Index3 low = glm::max(first, corner);
    const Index3 high = glm::min(end, corner + old_shape);
    const float constant = kind_at(source) == Field::Kind::inside ? new_limit_ : -new_limit_;
    for (std::int64_t z = low.z; z < high.z; ++z) {
      for (std::int64_t y = low.y; y < high.y; ++y) {
        const Index3 at = Index3(low.x, y, z);
        float* const to = values_.data() + number_in(new_shape, at - first);
        if (values == nullptr) {
          std::fill_n(to, high.x - low.x, constant);
          continue;
        }
        const float* const row = values + number_in(old_shape, at - corner);
        std::transform(row, row + (high.x - low.x), to, [this](float phi) { return in_band(phi); });
      }
    }
  }

  [[nodiscard]] float in_band(float phi) const {
    if (phi >= old_limit_) return new_limit_;
    if (phi <= -old_limit_) return -new_limit_;
    return std::clamp(phi, -new_limit_, new_limit_);
  }

  const Field& from_;
  Field& to_;
  float old_limit_;
  float new_limit_;
  std::vector<float> values_;  // of the page that is made
};

}  // namespace

Field Field::repaged(double new_band, Index3 page_shape) const {
  Field to = empty(geometry, new_band, page_shape);
  Repager repager(*this, to);
  for (std::int64_t page = 0; page < to.layout.page_count(); ++page) repager.make(page);
  to.store_between();
  return to;
}

}  // namespace tidemark::solver
