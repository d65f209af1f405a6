#include "core/user_folders.h"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>

namespace tidemark {
namespace {

namespace fs = std::filesystem;

fs::path folder_by(const char* variable, const char* below_home) {
  const char* chosen = std::getenv(variable);
  if (chosen != nullptr && *chosen == '/') return fs::path(chosen) / "tidemark";
  const char* home = std::getenv("HOME");
  return fs::path(home != nullptr ? home : "/") / below_home / "tidemark";
}

}  // namespace

fs::path user_configuration_file(const std::string& name) {
  return folder_by("XDG_CONFIG_HOME", ".config") / name;
}

fs::path user_state_folder() {
  return folder_by("XDG_STATE_HOME", ".local/state");
}

Status make_private_folder(const fs::path& folder) {
  const auto refuse = [&](const char* why) {
    return fail(ErrorKind::write, "{}: cannot be used as a private folder: {}", folder.string(), why);
  };
  std::error_code error;
  if (folder.has_parent_path()) fs::create_directories(folder.parent_path(), error);
  if (::mkdir(folder.c_str(), 0700) != 0 && errno != EEXIST) return refuse(std::strerror(errno));
  struct stat found {};
  if (::lstat(folder.c_str(), &found) != 0) return refuse(std::strerror(errno));
  if (!S_ISDIR(found.st_mode)) return refuse("not a folder");
  if (found.st_uid != ::geteuid()) return refuse("it is somebody else's");
  if ((found.st_mode & 0777U) != 0700U && ::chmod(folder.c_str(), 0700) != 0)
    return refuse(std::strerror(errno));
  return {};
}

}  // namespace tidemark
