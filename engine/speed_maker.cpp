#include "engine/speed_maker.h"

#include <algorithm>
#include <utility>

#include "core/without_exceptions.h"
#include "document/executor_setup.h"

namespace tidemark::engine {

namespace {

SpeedMaker::Made made_from(const SpeedOrigin& origin, std::shared_ptr<const Volume> source,
                           const Progress& progress) {
  if (source == nullptr) {
    progress(0.0, "smoothing");
    auto smoothed = document::smoothed_source(origin.volume, origin.smoothed_mm, progress);
    progress(1.0, "smoothing");
    if (!smoothed) return pass_on(smoothed);
    source = std::move(*smoothed);
  }
  const document::Drive drive{origin.setting, origin.images, origin.strokes, origin.map, nullptr};
  auto speed = document::make_speed(drive, source, solver::Parameters(), Progress{nullptr, progress.stop});
  if (!speed) return pass_on(speed);
  return SpeedMaker::Pair{std::move(source), std::move(*speed)};
}

// What cannot be handed over is given back: there is memory then to say so.
void hand_over(SpeedMaker::Made made, const SpeedMaker::Done& done) {
  const auto call = [&]() -> Status {
    done(std::move(made));
    return {};
  };
  const Status told = without_exceptions(call);
  if (told) return;
  made = tl::unexpected<Error>(told.error());
  static_cast<void>(without_exceptions(call));
}

}  // namespace

SpeedOrigin speed_origin(const document::Drive& drive, std::shared_ptr<const Volume> volume,
                         double smoothed_mm) {
  SpeedOrigin origin{drive.setting, std::move(volume), smoothed_mm, nullptr, {}, nullptr};
  for (const solver::SpeedTerm& term : drive.setting.terms) {
    const solver::SpeedKind* kind = solver::speed_kind(term.function);
    if (kind == nullptr) continue;
    if (kind->needs_strokes) origin.strokes = drive.strokes;
    if (kind->uses_images) origin.images = drive.images;
    if (kind->needs_map) origin.map = drive.map;
  }
  return origin;
}

SpeedMaker::~SpeedMaker() {
  give_up();
}

void SpeedMaker::give_up() {
  thread_.request_stop();
}

void SpeedMaker::make(const SpeedOrigin& origin, std::shared_ptr<const Volume> source, Report report,
                      Done done) {
  give_up();
  // Without a thread nobody waits for the one before.
  const auto before = std::make_shared<std::jthread>(std::move(thread_));
  const Status started = without_exceptions([&]() -> Status {
    thread_ = std::jthread([before, origin, source = std::move(source), report = std::move(report),
                            done](const std::stop_token& stop) mutable {
      if (before->joinable()) before->join();
      if (stop.stop_requested()) return;
      auto made = without_exceptions([&] {
        return made_from(origin, std::move(source), Progress{std::move(report), stop});
      });
      if (!stop.stop_requested()) hand_over(std::move(made), done);
    });
    return {};
  });
  if (started) return;
  thread_ = std::move(*before);
  done(tl::unexpected<Error>(started.error()));
}

}  // namespace tidemark::engine
