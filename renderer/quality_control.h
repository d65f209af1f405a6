// The choice of quality: coarse pictures while something moves, better ones afterwards. Knows no OpenGL.
#pragma once

#include <optional>

#include "renderer/picture.h"
#include "renderer/views.h"

namespace tidemark::renderer {

// One picture on the way to a finished one: a quick one is smaller than the view, and is shown
// enlarged.
struct Pass {
  PictureSize size;
  Quality quality;
  bool moving = false;
};

class QualityControl {
 public:
  static constexpr double kInteractive = 0.033;  // seconds a picture may take while something moves
  static constexpr std::int64_t kSmallest = 4;  // a moving picture has at least a fourth of the pixels a side
  static constexpr int kRounds = 8;  // pictures of a still view, at most, whose mean is the finished one

  explicit QualityControl(double budget_seconds = kInteractive) : budget_seconds_(budget_seconds) {}

  // The view (camera, level set, anything) has changed: the next picture keeps to the budget.
  void moved();
  // The next picture for a view of `full` physical pixels; none when the picture is finished, after `rounds`
  // still ones.
  [[nodiscard]] std::optional<Pass> next(PictureSize full, int rounds = kRounds) const;
  // That picture was drawn and took so long. If the view moved meanwhile, it does not count for the new
  // one.
  void drawn(const Pass& pass, double seconds);

 private:
  double budget_seconds_;
  int still_pictures_ = -1;              // since the view moved; -1: it has just moved
  std::optional<double> pixel_seconds_;  // of moving pictures, as far as is known
};

// The mean of a still view's pictures.
class PictureMean {
 public:
  // Starts anew with another size.
  void add(const Picture& picture);
  void clear() { count_ = 0; }
  [[nodiscard]] int count() const { return count_; }
  [[nodiscard]] Picture mean() const;

 private:
  PictureSize size_{0, 0};
  int count_ = 0;
  std::vector<std::uint32_t> sums_;
};

}  // namespace tidemark::renderer
