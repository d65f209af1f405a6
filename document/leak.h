// Leaks: places where a front narrowed to a neck and then grew behind it.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/geometry.h"
#include "solver/front_patches.h"

namespace tidemark::document {

struct LeakRule {
  // How many times wider than the neck (in area) the front must be, behind it and before it.
  double narrowing = 3.0;
  std::int64_t least_voxels = 100;  // behind the neck

  bool operator==(const LeakRule&) const = default;
};

struct Leak {
  std::vector<Index3> neck;  // the voxels behind it that touch what was there before: they close it
  Index3 middle{0};          // the one of them that is nearest to their centre
  double area_mm2 = 0.0;     // of the neck, as voxel faces
  double volume_ml = 0.0;    // behind it
  solver::FrontPatches::Look passed = 0;  // the look that saw the front in the neck
};

// Looks for a leak in the way that a front has come.
//
// A branch is a connected set of patches that arrived with some look or later. Its front at that look is its
// contact with older voxels, as the area of voxel faces. Going back in time the front of a leak is wide
// (behind the neck), narrow (in it) and wide again (before it, where it is part of the body's front). A
// vessel's front stays narrow, and that of a growing body narrows towards the start alone. Where the way back
// ends at the body, the largest section of a ball of its volume stands for the width before the neck.
class LeakFinder {
 public:
  // Of several leaks the one with the most volume behind its neck. Looks back over kMostPatches at most:
  // older ones count as the body.
  std::optional<Leak> find(const solver::FrontPatches& patches, const LeakRule& rule);

 private:
  using Number = solver::FrontPatches::Number;
  using Look = solver::FrontPatches::Look;

  struct Neck {
    Number patch = 0;  // one of its branch; 0: none
    Look passed = 0;
    double front_mm2 = 0.0;
    std::int64_t voxels = 0;
  };
  struct Branch {
    double front_mm2 = 0.0;
    std::int64_t voxels = 0;
    double widest_mm2 = 0.0;  // of its fronts since
    Neck neck;                // the narrowest place behind which it was wide
  };

  static constexpr std::size_t kMostPatches = 20'000;

  // Makes the branches of patches that arrived with the look `last` or later; judges them where it is told
  // to.
  void go_back(const solver::FrontPatches& patches, Look last, const LeakRule* rule);
  void join_newer(const solver::FrontPatches& patches, Number patch);
  void judge(Number patch, Look look, const LeakRule& rule);
  void consider(const Neck& neck, double before_mm2, const LeakRule& rule);
  Number& parent(Number patch) { return parents_[static_cast<std::size_t>(patch - first_)]; }
  Number root(Number patch);
  [[nodiscard]] Leak describe(const solver::FrontPatches& patches, const Neck& neck);

  [[nodiscard]] Branch& branch(Number patch) { return branches_[static_cast<std::size_t>(patch - first_)]; }

  Number first_ = 1;              // patch of those that are looked at
  std::vector<Number> parents_;   // of these
  std::vector<Branch> branches_;  // of roots
  double least_front_mm2_ = 0.0;  // what is smaller is no front, but what is left of sums
  std::optional<Neck> found_;
};

}  // namespace tidemark::document
