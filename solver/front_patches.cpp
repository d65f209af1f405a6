#include "solver/front_patches.h"

#include <algorithm>
#include <glm/common.hpp>
#include <unordered_set>

#include "solver/executor.h"
#include "solver/host/page_view.h"

namespace tidemark::solver {
namespace {

// Calls visit(first voxel, size, phi, page shape) for each page that is not outside throughout; phi is null
// where a page is inside throughout.
template <class Visit>
Status for_each_page(const Executor& executor, const Visit& visit) {
  PageView view;
  if (executor.page_view(view)) {
    const PageLayout& layout = view.memory->layout();
    for (std::int64_t page = 0; page < layout.page_count(); ++page) {
      const PhysicalPage physical = view.memory->physical(page);
      if (physical == kOutsidePage) continue;
      visit(layout.first_voxel(page), layout.valid_shape(page),
            physical == kInsidePage ? nullptr : view.phi(physical), layout.page_shape());
    }
    return {};
  }
  const auto phi = executor.snapshot();
  if (!phi) return pass_on(phi);
  for (std::int64_t page = 0; page < phi->layout.page_count(); ++page) {
    if (phi->pages.kind(page) == Field::Kind::outside) continue;
    visit(phi->layout.first_voxel(page), phi->layout.valid_shape(page), phi->pages.values(page),
          phi->layout.page_shape());
  }
  return {};
}

}  // namespace

FrontPatches::FrontPatches(const Geometry& geometry)
    : geometry_(geometry), pages_along_((geometry.size + kInEdge) >> std::int64_t{kEdgeBits}) {
  const glm::dvec3 s = geometry.spacing_mm;
  face_mm2_ = {s.y * s.z, s.x * s.z, s.x * s.y};
}

Status FrontPatches::restart(const Executor& executor) {
  looks_ = 0;
  voxels_arrived_ = 0;
  table_.assign(static_cast<std::size_t>(pages_along_.x * pages_along_.y * pages_along_.z), kNoPage);
  pages_.clear();
  missing_.clear();
  patches_.assign(1, {});
  return see(executor);
}

Result<std::int64_t> FrontPatches::look(const Executor& executor) {
  if (missing_.size() >= kMostPages) {
    TIDEMARK_TRY(restart(executor));
    return 0;
  }
  ++looks_;
  arrived_.clear();
  TIDEMARK_TRY(see(executor));
  for (const Place place : arrived_) {
    if (at(place) == kNew) add_patch(place);
  }
  voxels_arrived_ += static_cast<std::int64_t>(arrived_.size());
  return static_cast<std::int64_t>(arrived_.size());
}

// Looking.

Status FrontPatches::see(const Executor& executor) {
  return for_each_page(executor, [&](Index3 first, Index3 size, const float* phi, Index3 shape) {
    if (phi == nullptr && looks_ == 0 && size == shape && (shape & kInEdge) == Index3(0)) {
      return see_body(first, size);
    }
    if (phi != nullptr && shape == Index3(kEdge) && !brings_news(place_of(first), phi)) return;
    for (std::int64_t z = 0; z < size.z; ++z) {
      for (std::int64_t y = 0; y < size.y; ++y) {
        see_row(first + Index3(0, y, z), size.x,
                phi == nullptr ? nullptr : phi + number_in(shape, Index3(0, y, z)));
      }
    }
  });
}

// Whole pages inside at the first look need no memory.
void FrontPatches::see_body(Index3 first, Index3 size) {
  for (std::int64_t z = 0; z < size.z; z += kEdge) {
    for (std::int64_t y = 0; y < size.y; y += kEdge) {
      for (std::int64_t x = 0; x < size.x; x += kEdge) {
        table_[static_cast<std::size_t>(place_of(first + Index3(x, y, z)) >> kPageBits)] = kAllBody;
      }
    }
  }
  patches_[kBody].voxels += size.x * size.y * size.z;
}

// Whether a page of the same shape as ours may have voxels that are new inside.
bool FrontPatches::brings_news(Place first, const float* phi) const {
  const std::int32_t entry = table_[static_cast<std::size_t>(first >> kPageBits)];
  if (entry == kAllBody) return false;
  if (entry == kNoPage) return true;
  const Number* patches = pages_.data() + (std::int64_t{entry} << kPageBits);
  int news = 0;
  for (std::int64_t i = 0; i <= kInPage; ++i) {
    news |= static_cast<int>(phi[i] > 0.0F) & static_cast<int>(patches[i] == kNowhere);
  }
  return news != 0;
}

// `phi` is null where all of the row is inside.
void FrontPatches::see_row(Index3 first, std::int64_t length, const float* phi) {
  for (std::int64_t x = 0; x < length;) {
    const Place start = place_of(first + Index3(x, 0, 0));
    const std::int64_t end = std::min(length, x + kEdge - (start & kInEdge));
    const std::int32_t entry = table_[static_cast<std::size_t>(start >> kPageBits)];
    const bool whole = entry == kAllBody || (entry >= 0 && missing_[static_cast<std::size_t>(entry)] == 0);
    for (Place place = start; x < end; ++x, ++place) {
      if (whole || (phi != nullptr && phi[x] <= 0.0F)) continue;
      Number& patch = stored(place);
      if (patch != kNowhere) continue;
      --missing_[static_cast<std::size_t>(table_[static_cast<std::size_t>(place >> kPageBits)])];
      patch = looks_ == 0 ? kBody : kNew;
      if (looks_ == 0) {
        ++patches_[kBody].voxels;
      } else {
        arrived_.push_back(place);
      }
    }
  }
}

// All voxels that have arrived with this one, and are connected with it.
void FrontPatches::add_patch(Place start) {
  const auto number = static_cast<Number>(patches_.size());
  patches_.push_back({.look = looks_, .voxels = 0, .voxel = voxel_at(start), .older = {}, .newer = {}});
  stored(start) = number;
  waiting_.assign(1, start);
  while (!waiting_.empty()) {
    const Place place = waiting_.back();
    waiting_.pop_back();
    ++patches_.back().voxels;
    for (int axis = 0; axis < 3; ++axis) {
      for (const bool forward : {false, true}) {
        const Place next = neighbour(place, axis, forward);
        const Number other = at(next);
        if (other == kNew) {
          stored(next) = number;
          waiting_.push_back(next);
        } else if (other != kNowhere && other != number) {
          add_edge(number, other, face_mm2_[static_cast<std::size_t>(axis)]);
        }
      }
    }
  }
  for (const Edge& edge : patches_.back().older) {
    patches_[static_cast<std::size_t>(edge.to)].newer.push_back({number, edge.area_mm2});
  }
}

void FrontPatches::add_edge(Number patch, Number older, double area_mm2) {
  auto& edges = patches_[static_cast<std::size_t>(patch)].older;
  // The latest one is the most likely.
  const auto edge = std::find_if(edges.rbegin(), edges.rend(), [&](const Edge& e) { return e.to == older; });
  if (edge != edges.rend()) {
    edge->area_mm2 += area_mm2;
  } else {
    edges.push_back({older, area_mm2});
  }
}

// Places.

FrontPatches::Place FrontPatches::place_of(Index3 voxel) const {
  const Index3 page = voxel >> std::int64_t{kEdgeBits};
  const Index3 in = voxel & kInEdge;
  return (number_in(pages_along_, page) << kPageBits) + (((in.z << kEdgeBits) + in.y) << kEdgeBits) + in.x;
}

Index3 FrontPatches::voxel_at(Place place) const {
  const std::int64_t page = place >> kPageBits;
  const std::int64_t row = page / pages_along_.x;
  const Index3 first = Index3(page % pages_along_.x, row % pages_along_.y, row / pages_along_.y) * kEdge;
  return first + Index3(place & kInEdge, place >> kEdgeBits & kInEdge, place >> 2 * kEdgeBits & kInEdge);
}

FrontPatches::Place FrontPatches::neighbour(Place place, int axis, bool forward) const {
  const std::int64_t stride = std::int64_t{1} << axis * kEdgeBits;
  const std::int64_t in = place >> axis * kEdgeBits & kInEdge;
  if (forward ? in < kInEdge : in > 0) return forward ? place + stride : place - stride;
  Index3 voxel = voxel_at(place);
  voxel[axis] += forward ? 1 : -1;
  return geometry_.contains(voxel) ? place_of(voxel) : -1;
}

FrontPatches::Number FrontPatches::at(Place place) const {
  if (place < 0) return kNowhere;
  const std::int32_t entry = table_[static_cast<std::size_t>(place >> kPageBits)];
  if (entry < 0) return entry == kAllBody ? kBody : kNowhere;
  return pages_[static_cast<std::size_t>((std::int64_t{entry} << kPageBits) + (place & kInPage))];
}

FrontPatches::Number& FrontPatches::stored(Place place) {
  std::int32_t& entry = table_[static_cast<std::size_t>(place >> kPageBits)];
  if (entry < 0) {
    entry = static_cast<std::int32_t>(missing_.size());
    pages_.resize(pages_.size() + (std::size_t{1} << kPageBits), kNowhere);
    missing_.push_back(1 << kPageBits);
  }
  return pages_[static_cast<std::size_t>((std::int64_t{entry} << kPageBits) + (place & kInPage))];
}

std::vector<Index3> FrontPatches::voxels_beside(Number patch,
                                                const std::function<bool(Number)>& beside) const {
  std::vector<Index3> voxels;
  const Place start = place_of(patches_[static_cast<std::size_t>(patch)].voxel);
  std::vector<Place> waiting{start};
  std::unordered_set<Place> seen{start};
  while (!waiting.empty()) {
    const Place place = waiting.back();
    waiting.pop_back();
    bool touches = false;
    for (int axis = 0; axis < 3; ++axis) {
      for (const bool forward : {false, true}) {
        const Place next = neighbour(place, axis, forward);
        const Number other = at(next);
        if (other == patch && seen.insert(next).second) waiting.push_back(next);
        touches = touches || (other != kNowhere && other != patch && beside(other));
      }
    }
    if (touches) voxels.push_back(voxel_at(place));
  }
  return voxels;
}

}  // namespace tidemark::solver
