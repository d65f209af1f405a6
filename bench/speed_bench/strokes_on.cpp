#include "strokes_on.h"

#include <set>

namespace tidemark {
namespace {

constexpr std::int64_t kRadius = 3;        // voxels
constexpr std::int64_t kBeyondBorder = 5;  // of strokes outside, in voxels

class Painter {
 public:
  explicit Painter(const engine::LoadedStudy& study) : study_(study), grid_(study.volume->geometry) {}

  void paint(Index3 centre, bool inside) {
    for (std::int64_t y = -kRadius; y <= kRadius; ++y) {
      for (std::int64_t x = -kRadius; x <= kRadius; ++x) {
        const Index3 voxel = centre + Index3(x, y, 0);
        if (x * x + y * y > kRadius * kRadius || !grid_.contains(voxel)) continue;
        (inside ? inside_ : outside_).insert(grid_.offset(voxel));
      }
    }
  }
  // From the start to where the tumour ends; of a study without one, a fifth of the volume away.
  [[nodiscard]] Index3 beyond_border(Index3 way) const {
    const Index3 start = start_of(study_);
    std::int64_t length = std::min({grid_.size.x, grid_.size.y, grid_.size.z}) / 5;
    if (study_.truth) {
      for (length = 0; is_inside(start + way * length); ++length) {
      }
    }
    return start + way * (length + kBeyondBorder);
  }
  [[nodiscard]] std::shared_ptr<const solver::Strokes> strokes() const {
    auto strokes = std::make_shared<solver::Strokes>();
    strokes->inside.assign(inside_.begin(), inside_.end());
    for (const std::int64_t voxel : outside_) {
      if (!inside_.contains(voxel)) strokes->outside.push_back(voxel);
    }
    return strokes;
  }

 private:
  [[nodiscard]] bool is_inside(Index3 voxel) const {
    return grid_.contains(voxel) && study_.truth->contains(grid_.offset(voxel));
  }

  const engine::LoadedStudy& study_;
  Geometry grid_;
  std::set<std::int64_t> inside_;
  std::set<std::int64_t> outside_;
};

}  // namespace

std::shared_ptr<const solver::Strokes> strokes_on(const engine::LoadedStudy& study, int more) {
  Painter painter(study);
  const Index3 start = start_of(study);
  painter.paint(start, true);
  painter.paint(start + Index3(0, 0, 4), true);
  for (const Index3 way : {Index3(1, 0, 0), Index3(-1, 0, 0), Index3(0, 1, 0)})
    painter.paint(painter.beyond_border(way), false);
  for (int stroke = 0; stroke < more; ++stroke)
    painter.paint(painter.beyond_border({0, -1, 0}) + Index3(0, 0, 2 * stroke), false);
  return painter.strokes();
}

}  // namespace tidemark
