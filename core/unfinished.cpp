#include "core/unfinished.h"

#include <mutex>
#include <set>
#include <system_error>
#include <utility>

namespace tidemark {
namespace {

// Never destroyed: threads may outlive main().
struct All {
  std::mutex mutex;
  std::set<std::filesystem::path> paths;
};

All& all() {
  static All& known = *new All;
  return known;
}

}  // namespace

Unfinished::Unfinished(const std::filesystem::path& path) {
  std::error_code error;
  path_ = std::filesystem::absolute(path, error);  // the program may go elsewhere
  const std::lock_guard lock(all().mutex);
  all().paths.insert(path_);
}

Unfinished::~Unfinished() {
  if (path_.empty()) return;
  const std::lock_guard lock(all().mutex);
  all().paths.erase(path_);
}

Unfinished::Unfinished(Unfinished&& other) noexcept : path_(std::exchange(other.path_, {})) {}

Unfinished& Unfinished::operator=(Unfinished&& other) noexcept {
  std::swap(path_, other.path_);
  return *this;
}

void remove_unfinished() {
  const std::lock_guard lock(all().mutex);
  std::error_code ignored;
  for (const std::filesystem::path& path : all().paths) std::filesystem::remove_all(path, ignored);
}

}  // namespace tidemark
