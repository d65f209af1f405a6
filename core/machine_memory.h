// The memory that this process may use.
#pragma once

#include <cstdint>
#include <filesystem>

namespace tidemark {

// The machine's physical memory in bytes, or the limit of the control group that this process runs in, where
// that is lower. Does not change while the process runs.
std::int64_t machine_memory();

// The lowest limit in bytes of the control groups that `groups` (/proc/self/cgroup) names and of those above
// them, below `root` (/sys/fs/cgroup); of both versions of the interface. The largest number when there is
// none.
std::int64_t control_group_limit(const std::filesystem::path& groups, const std::filesystem::path& root);

}  // namespace tidemark
