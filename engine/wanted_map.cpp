#include "engine/wanted_map.h"

#include <utility>

#include "engine/background_job.h"

namespace tidemark::engine {

WantedMap::~WantedMap() {
  if (job_) job_->abandon();
}

void WantedMap::set_make(Make make) {
  make_ = std::move(make);
  map_.reset();
  if (job_) job_->abandon();
  job_.reset();
  if (std::exchange(shown_, false)) show_(nullptr);
  follow();
}

void WantedMap::set_wanted(bool wanted) {
  wanted_ = wanted;
  follow();
}

void WantedMap::follow() {
  const bool shows = wanted_ && make_;
  if (shows == shown_) return;
  if (!shows || map_) {
    shown_ = shows;
    return show_(shows ? map_ : nullptr);
  }
  if (job_) return;
  job_ = BackgroundJob::start(
      this,
      [this, make = make_](BackgroundJob& job) {
        job.deliver([this, map = make()] {
          job_.reset();
          map_ = map;
          follow();
        });
      },
      [this](const Error&) { job_.reset(); });
}

}  // namespace tidemark::engine
