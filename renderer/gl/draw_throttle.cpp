#include "renderer/gl/draw_throttle.h"

#include <algorithm>

#include "gpu/device.h"

namespace tidemark::renderer {

// The compiling of a first draw is no piece: it happens in this thread, and no other context waits for it. It
// may depend on the program before (gpu::SamplerSlots).
Status DrawThrottle::prepare(const gpu::Program& program) {
  if (&program == in_use_) return {};
  const std::pair change(in_use_, &program);
  in_use_ = &program;
  if (std::find(prepared_.begin(), prepared_.end(), change) != prepared_.end()) return {};
  TIDEMARK_TRY(wait());
  const Stopwatch watch;
  gpu::prepare_draw();
  report_.prepare_seconds += watch.seconds();
  prepared_.push_back(change);
  return {};
}

Status DrawThrottle::before(double work) {
  if (on_its_way_ > 0.0 && (on_its_way_ + work) * seconds_each_ > Canvas::kWantedPiece) {
    TIDEMARK_TRY(wait());
  }
  if (on_its_way_ == 0.0) since_begun_.restart();
  on_its_way_ += work;
  return {};
}

Status DrawThrottle::wait() {
  if (!device_.capabilities().software || on_its_way_ == 0.0) return {};
  TIDEMARK_TRY(gpu::Fence::insert(device_).wait());
  const double took = since_begun_.seconds();
  ++report_.pieces;
  report_.seconds += took;
  report_.longest_piece_seconds = std::max(report_.longest_piece_seconds, took);
  // Slowly to quicker work, as behind empty places hard ones may come.
  seconds_each_ = std::max(took / on_its_way_, 0.7 * seconds_each_);
  on_its_way_ = 0.0;
  return {};
}

Status DrawThrottle::things(const gpu::Program& program, std::int64_t count, std::int64_t fragments_each,
                            double weight, const DrawSome& draw) {
  if (!device_.capabilities().software) {
    if (progress_.cancelled()) return cancelled_error();
    draw(0, count);
    return {};
  }
  TIDEMARK_TRY(prepare(program));
  const double each = weight * static_cast<double>(std::max<std::int64_t>(fragments_each, 1));
  for (std::int64_t first = 0; first < count;) {
    const auto most = static_cast<std::int64_t>(Canvas::kWantedPiece / (each * seconds_each_));
    const std::int64_t some = std::clamp<std::int64_t>(most, 1, count - first);
    if (progress_.cancelled()) return cancelled_error();
    TIDEMARK_TRY(before(each * static_cast<double>(some)));
    draw(first, some);
    first += some;
  }
  return {};
}

Status DrawThrottle::rectangle(const gpu::Program& program, const gpu::TexelRect& rect, double weight,
                               const Draw& draw) {
  return things(program, rect.height, rect.width, weight, [&](std::int64_t first, std::int64_t count) {
    draw({rect.x, rect.y + first, rect.width, count});
  });
}

}  // namespace tidemark::renderer
