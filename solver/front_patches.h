// The way that a front has come: in patches of voxels that it reached together.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "core/geometry.h"
#include "core/result.h"

namespace tidemark::solver {

class Executor;

// Takes looks at a level set between its steps. The voxels that a look is the first to see inside, connected
// across faces, are a patch. A voxel that goes outside again stays in its patch.
class FrontPatches {
 public:
  using Number = std::int32_t;            // of a patch
  static constexpr Number kNowhere = -1;  // never inside, or beyond the volume
  static constexpr Number kBody = 0;      // inside at the first look
  using Look = std::int32_t;              // its number; 0: the first

  struct Edge {
    Number to = kBody;
    double area_mm2 = 0.0;  // of the voxel faces between the two
  };
  struct Patch {
    Look look = 0;
    std::int64_t voxels = 0;
    Index3 voxel{0};          // one of them
    std::vector<Edge> older;  // the patches beside it that were there before
    std::vector<Edge> newer;  // the same edges from the other side
  };

  explicit FrontPatches(const Geometry& geometry);

  // The first look: everything inside is the body. Fails as Executor::snapshot() does.
  Status restart(const Executor& executor);
  // Another one. Returns how many voxels have arrived since the last. Begins anew when what it keeps has
  // grown to kMostPages. Fails as Executor::snapshot() does.
  Result<std::int64_t> look(const Executor& executor);

  [[nodiscard]] const Geometry& geometry() const { return geometry_; }
  [[nodiscard]] Look looks() const { return looks_; }
  // Inside at some look.
  [[nodiscard]] std::int64_t voxels() const { return patches_.front().voxels + voxels_arrived_; }
  // In the order of looks; the first is the body, whose voxel says nothing.
  [[nodiscard]] const std::vector<Patch>& patches() const { return patches_; }
  [[nodiscard]] Number at(Index3 voxel) const;
  // The voxels of a patch that have a face to a patch for which `beside` holds.
  [[nodiscard]] std::vector<Index3> voxels_beside(Number patch,
                                                  const std::function<bool(Number)>& beside) const;

 private:
  // Where a voxel's patch is kept: its page of 8 x 8 x 8, and its place in it. Padding has places too.
  using Place = std::int64_t;
  static constexpr int kEdgeBits = 3;
  static constexpr int kPageBits = 3 * kEdgeBits;
  static constexpr std::int64_t kEdge = 1 << kEdgeBits;
  static constexpr std::int64_t kInEdge = kEdge - 1;
  static constexpr std::int64_t kInPage = (1 << kPageBits) - 1;
  static constexpr std::size_t kMostPages = 100'000;  // 200 MiB
  static constexpr Number kNew = -2;                  // inside, in no patch yet
  static constexpr std::int32_t kNoPage = -1;
  static constexpr std::int32_t kAllBody = -2;

  [[nodiscard]] Place place_of(Index3 voxel) const;
  [[nodiscard]] Index3 voxel_at(Place place) const;
  [[nodiscard]] Place neighbour(Place place, int axis, bool forward) const;  // < 0: there is none
  [[nodiscard]] Number at(Place place) const;
  Number& stored(Place place);

  Status see(const Executor& executor);
  [[nodiscard]] bool brings_news(Place first, const float* phi) const;
  void see_body(Index3 first, Index3 size);
  void see_row(Index3 first, std::int64_t length, const float* phi);
  void add_patch(Place start);
  void add_edge(Number patch, Number older, double area_mm2);

  Geometry geometry_;
  std::array<double, 3> face_mm2_;  // across each axis
  Index3 pages_along_{0};
  std::vector<std::int32_t> table_;  // of each page: its index in pages_, kNoPage, or kAllBody
  std::vector<Number> pages_;
  std::vector<std::int32_t> missing_;  // places where none has arrived yet, of each page that is stored
  std::vector<Place> arrived_;         // with this look
  std::vector<Place> waiting_;         // to be visited
  std::vector<Patch> patches_;
  std::int64_t voxels_arrived_ = 0;  // since the first look
  Look looks_ = 0;
};

}  // namespace tidemark::solver
