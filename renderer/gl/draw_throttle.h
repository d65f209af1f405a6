// A throttle that keeps drawing from holding a processor that plays the GPU for long.
#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "core/progress.h"
#include "core/stopwatch.h"
#include "gpu/program.h"
#include "gpu/texture.h"
#include "renderer/gl/canvas.h"

namespace tidemark::renderer {

// On such a processor, contexts share one rasteriser: many small draws one after the other, as a picture from
// slices needs, are waited for whenever about kWantedPiece of work is queued, and large ones are cut. On a
// GPU nothing is waited for.
class DrawThrottle {
 public:
  DrawThrottle(gpu::Device& device, const Progress& progress) : device_(device), progress_(progress) {}

  // Draws a rectangle with `draw`, whole or in parts, with this program, which is in use. `weight`: the
  // cost of a fragment, relative to other draws. Fails (ErrorKind::cancelled) between two parts on a request
  // to stop.
  using Draw = std::function<void(const gpu::TexelRect&)>;
  Status rectangle(const gpu::Program& program, const gpu::TexelRect& rect, double weight, const Draw& draw);
  // The same for `count` things of so many fragments each.
  using DrawSome = std::function<void(std::int64_t first, std::int64_t count)>;
  Status things(const gpu::Program& program, std::int64_t count, std::int64_t fragments_each, double weight,
                const DrawSome& draw);
  // Waits for the queued work. The GPU's own work between two draws is not counted.
  Status wait();

  [[nodiscard]] const DrawReport& report() const { return report_; }

 private:
  Status prepare(const gpu::Program& program);
  Status before(double work);

  gpu::Device& device_;
  const Progress& progress_;
  double seconds_each_ = 200e-9;  // a fragment of weight 1; measured on the way
  double on_its_way_ = 0.0;       // fragments, weighted
  Stopwatch since_begun_;
  const gpu::Program* in_use_ = nullptr;
  std::vector<std::pair<const gpu::Program*, const gpu::Program*>> prepared_;  // changes from one to another
  DrawReport report_;
};

}  // namespace tidemark::renderer
