// Progress of work that several threads share.
#pragma once

#include <cstdint>
#include <mutex>
#include <string_view>

#include "core/progress.h"

namespace tidemark::imaging {

// Counts finished pieces and reports them one call at a time.
class SharedProgress {
 public:
  SharedProgress(const Progress& progress, std::int64_t total, std::string_view what)
      : progress_(progress), total_(total), what_(what) {}

  void advance() {
    const std::lock_guard lock(mutex_);
    ++done_;
    progress_(static_cast<double>(done_) / static_cast<double>(total_), what_);
  }

 private:
  const Progress& progress_;
  std::int64_t total_;
  std::string_view what_;
  std::mutex mutex_;
  std::int64_t done_ = 0;
};

}  // namespace tidemark::imaging
