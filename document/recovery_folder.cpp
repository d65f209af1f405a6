#include "document/recovery_folder.h"

#include <algorithm>
#include <cctype>
#include <random>
#include <utility>

#include "core/user_folders.h"

namespace tidemark::document {
namespace {

std::filesystem::path lock_file(const std::filesystem::path& folder, const std::string& id) {
  return folder / (id + ".lock");
}

}  // namespace

std::string new_copy_id() {
  std::random_device random;
  return fmt::format("{:08x}{:08x}", random(), random());
}

bool is_copy_id(const std::string& id) {
  const auto allowed = [](unsigned char c) { return c < 128 && (std::isalnum(c) != 0 || c == '-'); };
  return !id.empty() && id.size() <= 64 && std::all_of(id.begin(), id.end(), allowed);
}

Result<FileLock> hold_copy(const std::filesystem::path& folder, const std::string& id) {
  if (!is_copy_id(id)) return fail(ErrorKind::usage, "'{}' names no case", id);
  TIDEMARK_TRY(make_private_folder(folder));
  FileLock lock = FileLock::take(lock_file(folder, id), FileLock::Missing::make);
  if (!lock) return fail(ErrorKind::write, "{}: cannot be locked", lock_file(folder, id).string());
  return lock;
}

bool is_held(const std::filesystem::path& folder, const std::string& id) {
  const auto file = lock_file(folder, id);
  return std::filesystem::exists(std::filesystem::symlink_status(file)) && !FileLock::take(file);
}

std::vector<std::string> left_copies(const std::filesystem::path& folder, std::string_view suffix) {
  std::vector<std::string> ids;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    std::string id = name.substr(0, name.find('.'));
    if (!name.ends_with(suffix) || !is_copy_id(id) || is_held(folder, id)) continue;
    if (std::find(ids.begin(), ids.end(), id) == ids.end()) ids.push_back(std::move(id));
  }
  return ids;
}

void remove_hold(const std::filesystem::path& folder, const std::string& id) {
  std::error_code ignored;
  std::filesystem::remove(lock_file(folder, id), ignored);
}

}  // namespace tidemark::document
