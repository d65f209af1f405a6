// Values that are made of a volume, once for all that use it at the same time.
#pragma once

#include <algorithm>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <stop_token>
#include <vector>

#include "core/progress.h"
#include "core/volume.h"

namespace tidemark::solver {

// Keeps neither the volumes nor what was made of them alive. May be used by several threads at once.
template <class Made>
class SharedByVolume {
 public:
  using Make = std::function<Result<std::shared_ptr<const Made>>()>;

  // What is in use already, or else what `make` makes. Who asks for what is in the making waits for it, and
  // makes it where that failed. Fails as `make` does, and (ErrorKind::cancelled) as soon as `stop` asks for
  // it.
  Result<std::shared_ptr<const Made>> of(const std::shared_ptr<const Volume>& volume,
                                         const std::stop_token& stop, const Make& make) {
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, stop, [&] { return !entry_of(volume).in_the_making; });
      if (stop.stop_requested()) return cancelled_error();
      std::erase_if(entries_, [](const Entry& one) { return !one.in_the_making && one.made.expired(); });
      Entry& entry = entry_of(volume);
      if (auto there = entry.made.lock()) return there;
      entry.in_the_making = true;
    }
    Making making(*this, volume);
    auto made = make();
    if (made) making.done(*made);
    return made;
  }

 private:
  struct Entry {
    std::weak_ptr<const Volume> volume;
    std::weak_ptr<const Made> made;
    bool in_the_making = false;
  };

  // Ends with the scope, also where nothing was made.
  class Making {
   public:
    Making(SharedByVolume& all, const std::shared_ptr<const Volume>& volume) : all_(all), volume_(volume) {}
    Making(const Making&) = delete;
    Making& operator=(const Making&) = delete;
    ~Making() {
      const std::lock_guard lock(all_.mutex_);
      Entry& entry = all_.entry_of(volume_);
      entry.made = made_;
      entry.in_the_making = false;
      all_.changed_.notify_all();
    }
    void done(const std::shared_ptr<const Made>& made) { made_ = made; }

   private:
    SharedByVolume& all_;
    const std::shared_ptr<const Volume>& volume_;
    std::weak_ptr<const Made> made_;
  };

  // An empty one where there was none.
  Entry& entry_of(const std::shared_ptr<const Volume>& volume) {
    const auto found = std::find_if(entries_.begin(), entries_.end(),
                                    [&](const Entry& one) { return one.volume.lock() == volume; });
    return found != entries_.end() ? *found : entries_.emplace_back(Entry{volume, {}, false});
  }

  std::mutex mutex_;
  std::condition_variable_any changed_;  // an entry is no longer in the making
  std::vector<Entry> entries_;
};

}  // namespace tidemark::solver
