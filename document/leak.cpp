#include "document/leak.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

namespace tidemark::document {
namespace {

using solver::FrontPatches;

std::size_t index(FrontPatches::Number patch) {
  return static_cast<std::size_t>(patch);
}

double smallest_face_mm2(const Geometry& geometry) {
  const glm::dvec3 s = geometry.spacing_mm;
  return std::min({s.x * s.y, s.y * s.z, s.z * s.x});
}

// The largest section of a ball of that volume.
double section_of_ball_mm2(double volume_mm3) {
  return M_PI * std::pow(0.75 / M_PI * volume_mm3, 2.0 / 3.0);
}

}  // namespace

std::optional<Leak> LeakFinder::find(const FrontPatches& patches, const LeakRule& rule) {
  found_.reset();
  least_front_mm2_ = 0.5 * smallest_face_mm2(patches.geometry());
  const auto& all = patches.patches();
  const Look earliest = all.size() > kMostPatches ? all[all.size() - kMostPatches].look + 1 : 1;
  go_back(patches, earliest, &rule);
  // What is left over hangs on the body.
  std::int64_t body = patches.voxels();
  for (auto patch = static_cast<Number>(all.size()); patch-- > first_;) body -= all[index(patch)].voxels;
  const double body_mm2 =
      section_of_ball_mm2(static_cast<double>(body) * patches.geometry().voxel_volume_ml() * 1000.0);
  for (auto patch = static_cast<Number>(all.size()); patch-- > first_;) {
    if (parent(patch) == patch && branch(patch).neck.patch != 0) {
      consider(branch(patch).neck, body_mm2, rule);
    }
  }
  if (!found_) return std::nullopt;
  return describe(patches, *found_);
}

void LeakFinder::go_back(const FrontPatches& patches, Look last, const LeakRule* rule) {
  const auto& all = patches.patches();
  const auto older = [&](const auto& patch, Look look) { return patch.look < look; };
  const auto found = std::lower_bound(all.begin() + 1, all.end(), last, older);
  first_ = static_cast<Number>(found - all.begin());
  parents_.resize(all.size() - index(first_));
  branches_.assign(parents_.size(), {});
  for (auto end = static_cast<Number>(all.size()); end > first_;) {
    const Look look = all[index(end - 1)].look;
    Number begin = end;
    while (begin > first_ && all[index(begin - 1)].look == look) --begin;
    for (Number patch = begin; patch < end; ++patch) {
      parent(patch) = patch;
      branch(patch).voxels = all[index(patch)].voxels;
      for (const auto& edge : all[index(patch)].older) branch(patch).front_mm2 += edge.area_mm2;
    }
    for (Number patch = begin; patch < end; ++patch) join_newer(patches, patch);
    for (Number patch = begin; rule != nullptr && patch < end; ++patch) judge(root(patch), look, *rule);
    end = begin;
  }
}

// With the branches whose front this patch was.
void LeakFinder::join_newer(const FrontPatches& patches, Number patch) {
  for (const auto& newer : patches.patches()[index(patch)].newer) {
    Number kept = root(patch);
    Number gone = root(newer.to);
    branch(gone).front_mm2 -= newer.area_mm2;
    if (kept == gone) continue;
    if (branch(kept).voxels < branch(gone).voxels) std::swap(kept, gone);
    Branch& whole = branch(kept);
    const Branch& part = branch(gone);
    parent(gone) = kept;
    whole.front_mm2 += part.front_mm2;
    whole.voxels += part.voxels;
    whole.widest_mm2 = std::max(whole.widest_mm2, part.widest_mm2);
    if (part.neck.voxels > whole.neck.voxels) whole.neck = part.neck;
  }
}

void LeakFinder::judge(Number patch, Look look, const LeakRule& rule) {
  Branch& it = branch(patch);
  // A branch without a face to older voxels has come across an edge or from nowhere: nothing would close it.
  const bool narrow = it.front_mm2 >= least_front_mm2_ && it.front_mm2 * rule.narrowing <= it.widest_mm2 &&
                      it.voxels >= rule.least_voxels;
  if (it.neck.patch != 0 && it.front_mm2 >= rule.narrowing * it.neck.front_mm2) {
    consider(it.neck, it.front_mm2, rule);
    it.neck = {};
    it.widest_mm2 = it.front_mm2;
  } else if (narrow && (it.neck.patch == 0 || it.front_mm2 < it.neck.front_mm2)) {
    it.neck = {patch, look, it.front_mm2, it.voxels};
  } else {
    it.widest_mm2 = std::max(it.widest_mm2, it.front_mm2);
  }
}

void LeakFinder::consider(const Neck& neck, double before_mm2, const LeakRule& rule) {
  if (before_mm2 < rule.narrowing * neck.front_mm2) return;
  if (!found_ || neck.voxels > found_->voxels) found_ = neck;
}

LeakFinder::Number LeakFinder::root(Number patch) {
  while (parent(patch) != patch) {
    parent(patch) = parent(parent(patch));
    patch = parent(patch);
  }
  return patch;
}

Leak LeakFinder::describe(const FrontPatches& patches, const Neck& neck) {
  Leak leak;
  leak.area_mm2 = neck.front_mm2;
  leak.volume_ml = static_cast<double>(neck.voxels) * patches.geometry().voxel_volume_ml();
  leak.passed = neck.passed;
  go_back(patches, neck.passed, nullptr);
  const auto& all = patches.patches();
  const auto is_older = [&](Number patch) { return all[index(patch)].look < neck.passed; };
  const Number leaking = root(neck.patch);
  for (Number patch = first_; patch < static_cast<Number>(all.size()); ++patch) {
    const auto& edges = all[index(patch)].older;
    const bool touches =
        std::any_of(edges.begin(), edges.end(), [&](const auto& e) { return is_older(e.to); });
    if (!touches || root(patch) != leaking) continue;
    const auto voxels = patches.voxels_beside(patch, is_older);
    leak.neck.insert(leak.neck.end(), voxels.begin(), voxels.end());
  }
  glm::dvec3 sum(0.0);
  for (const Index3& voxel : leak.neck) sum += glm::dvec3(voxel);
  const glm::dvec3 centre = sum / static_cast<double>(leak.neck.size());
  const auto distance = [&](const Index3& v) { return glm::distance(glm::dvec3(v), centre); };
  leak.middle = *std::min_element(leak.neck.begin(), leak.neck.end(), [&](const Index3& a, const Index3& b) {
    return distance(a) < distance(b);
  });
  return leak;
}

}  // namespace tidemark::document
