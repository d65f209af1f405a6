// The most memory that a piece of work took beside what the process had before it (Linux).
#pragma once

#include <malloc.h>

#include <cstdint>
#include <fstream>
#include <string>
#include <string_view>

namespace tidemark::bench {

// A field of /proc/self/status in bytes, or 0.
inline std::int64_t process_bytes(std::string_view field) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with(field)) return 1024 * std::stoll(line.substr(field.size() + 1));
  }
  return 0;
}

class PeakMemory {
 public:
  // Gives back what is free, so that work cannot hide in it, and forgets the former peak (proc(5)).
  PeakMemory() {
    ::malloc_trim(0);
    std::ofstream("/proc/self/clear_refs") << "5\n";
    before_ = process_bytes("VmRSS:");
  }
  [[nodiscard]] std::int64_t bytes() const { return process_bytes("VmHWM:") - before_; }

 private:
  std::int64_t before_ = 0;
};

}  // namespace tidemark::bench
