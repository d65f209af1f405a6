// Work in a process of its own, which can be killed or find the disk full.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "core/result.h"

namespace tidemark::test {

// When and how the work is disturbed. As it stands: not at all.
struct Disturbance {
  // No file may grow beyond so many bytes. The byte after them ends the process at once, as SIGKILL would, or
  // it cannot be written, as on a full disk.
  std::optional<std::int64_t> largest_file{};
  bool is_fatal = true;
  // SIGKILL when so many files and folders have come, gone, got another name or been closed in `watched`.
  int events = 0;
  std::filesystem::path watched{};
  // So many bytes of memory may be taken in addition to what there is.
  std::optional<std::int64_t> more_memory{};
};

struct Ended {
  bool was_killed = false;
  std::string failure;  // what the work's Status says; empty: it succeeded, or was killed
};

// From now on permissions of files hold for this process, and for programs that it becomes, though it be
// root's. To be called in a child.
void give_up_privileges();

// Forks, so the work must not need threads that run already.
Ended run_in_child(const std::function<Status()>& work, const Disturbance& disturbance = {});

}  // namespace tidemark::test
