#include "engine/speed_maker.h"

#include <algorithm>
#include <utility>

#include "core/without_exceptions.h"

namespace tidemark::engine {

SpeedOrigin speed_origin(const document::Drive& drive, std::shared_ptr<const Volume> source,
                         const solver::Parameters& parameters) {
  SpeedOrigin origin{drive.setting, std::move(source), nullptr, {}, nullptr, {}};
  for (const solver::SpeedTerm& term : drive.setting.terms) {
    const solver::SpeedKind* kind = solver::speed_kind(term.function);
    if (kind == nullptr) continue;
    if (kind->needs_strokes) origin.strokes = drive.strokes;
    if (kind->uses_images) origin.images = drive.images;
    if (kind->needs_map) origin.map = drive.map;
    if (term.function == "tent") {
      origin.parameters = parameters;
      origin.parameters.alpha = solver::Parameters().alpha;  // D is the same for each
    }
  }
  return origin;
}

SpeedMaker::~SpeedMaker() {
  give_up();
}

void SpeedMaker::give_up() {
  thread_.request_stop();
}

void SpeedMaker::make(const SpeedOrigin& origin, Done done) {
  give_up();
  thread_ = std::jthread(
      [before = std::move(thread_), origin, done = std::move(done)](const std::stop_token& stop) mutable {
        if (before.joinable()) before.join();
        if (stop.stop_requested()) return;
        const document::Drive drive{origin.setting, origin.images, origin.strokes, origin.map, nullptr};
        auto made = without_exceptions([&] {
          return document::make_speed(drive, origin.source, origin.parameters, Progress{nullptr, stop});
        });
        if (!stop.stop_requested()) done(std::move(made));
      });
}

}  // namespace tidemark::engine
