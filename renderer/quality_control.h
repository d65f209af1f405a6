// The choice of quality: coarse pictures while something moves, better ones afterwards. Knows no OpenGL.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "renderer/picture.h"
#include "renderer/views.h"

namespace tidemark::renderer {

// One picture on the way to a finished one: a quick one is smaller than the view, and is shown
// enlarged.
struct Pass {
  PictureSize size;
  Quality quality;
  bool moving = false;
  int divisor = 1;  // of the view's pixels a side
};

class QualityControl {
 public:
  static constexpr double kInteractive = 0.033;  // seconds a picture may take while something moves
  // The same while a surface plays: most of the processor's time belongs to the solver.
  static constexpr double kPlaying = 0.004;
  static constexpr double kForHalf = 1.5;  // a picture of half the pixels a side may take so many times it
  static constexpr int kSmallest = 4;      // a moving picture has at least a fourth of the pixels a side
  static constexpr int kRounds = 9;  // pictures of a still view, at most, whose mean is the finished one

  // The view (camera, level set, anything) has changed: the next picture keeps to the budget.
  void moved();
  // The next picture for a view of `full` physical pixels; none when the picture is finished, after `rounds`
  // still ones. One that moves may take so many seconds.
  [[nodiscard]] std::optional<Pass> next(PictureSize full, int rounds = kRounds,
                                         double seconds = kInteractive) const;
  // That picture was drawn and took so long, of whose pixels a share was painted. If the view moved
  // meanwhile, it does not count for the new one.
  void drawn(const Pass& pass, double seconds, double painted = 1.0);

 private:
  // Seconds that a moving picture of that divisor is expected to take for each of its pixels; none at first.
  [[nodiscard]] std::optional<double> expected_pixel_seconds(int divisor) const;

  int still_pictures_ = -1;  // since the view moved; -1: it has just moved
  std::array<std::optional<double>, kSmallest + 1> pixel_seconds_;  // of moving pictures, by divisor
};

// The mean of a still view's pictures.
class PictureMean {
 public:
  // Starts anew with another size.
  void add(const Picture& picture);
  void clear() { count_ = 0; }
  [[nodiscard]] int count() const { return count_; }
  [[nodiscard]] PictureSize size() const { return size_; }
  [[nodiscard]] Picture mean() const;

 private:
  PictureSize size_{0, 0};
  int count_ = 0;
  std::vector<std::uint32_t> sums_;
};

// For each pixel whether it differs from one of its four neighbours by more than `levels` in red, green or
// blue: on edges, and where there is noise. Elsewhere further rounds change little: thin things that all the
// first rays missed.
std::vector<std::uint8_t> uneven_pixels(const Picture& picture, int levels = 12);

}  // namespace tidemark::renderer
