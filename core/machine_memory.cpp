#include "core/machine_memory.h"

#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

namespace tidemark {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kNoLimit = std::numeric_limits<std::int64_t>::max();

// "max" and what does not fit are no limit.
std::int64_t limit_in(const fs::path& file) {
  std::ifstream stream(file);
  std::int64_t bytes = 0;
  return stream >> bytes && bytes > 0 ? bytes : kNoLimit;
}

// Of a group and of all above it. In a container the path may be that of the host, which is not seen there:
// its own group is then the root.
std::int64_t lowest_limit(const fs::path& root, const fs::path& group, const char* file) {
  std::int64_t lowest = limit_in(root / file);
  fs::path at = root;
  for (const fs::path& part : group.relative_path()) {
    at /= part;
    lowest = std::min(lowest, limit_in(at / file));
  }
  return lowest;
}

}  // namespace

std::int64_t control_group_limit(const fs::path& groups, const fs::path& root) {
  std::int64_t lowest = kNoLimit;
  std::ifstream stream(groups);
  // "0::/path" in version 2, "7:cpu,memory:/path" in version 1.
  for (std::string line; std::getline(stream, line);) {
    const auto first = line.find(':');
    const auto second = first == std::string::npos ? first : line.find(':', first + 1);
    if (second == std::string::npos) continue;
    const std::string controllers = "," + line.substr(first + 1, second - first - 1) + ",";
    const fs::path group = line.substr(second + 1);
    if (controllers == ",,") lowest = std::min(lowest, lowest_limit(root, group, "memory.max"));
    if (controllers.find(",memory,") != std::string::npos) {
      lowest = std::min(lowest, lowest_limit(root / "memory", group, "memory.limit_in_bytes"));
    }
  }
  return lowest;
}

std::int64_t machine_memory() {
  static const std::int64_t bytes = [] {
    const std::int64_t physical =
        static_cast<std::int64_t>(::sysconf(_SC_PHYS_PAGES)) * ::sysconf(_SC_PAGESIZE);
    return std::min(physical, control_group_limit("/proc/self/cgroup", "/sys/fs/cgroup"));
  }();
  return bytes;
}

}  // namespace tidemark
