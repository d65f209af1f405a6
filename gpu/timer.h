// A timer on the GPU's own clock.
#pragma once

#include "gpu/handles.h"

namespace tidemark::gpu {

// Only hardware is to be believed: llvmpipe counts when commands are queued.
class Timer {
 public:
  Timer() = default;
  static Timer create(Device& device);
  void begin() const;
  void end() const;
  // Waits for the commands between begin() and end().
  [[nodiscard]] double seconds() const;

 private:
  QueryHandle query_;
};

}  // namespace tidemark::gpu
