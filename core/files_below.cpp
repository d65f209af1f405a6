#include "core/files_below.h"

#include <algorithm>
#include <system_error>

#include "core/atomic_file.h"

namespace tidemark {

namespace fs = std::filesystem;

Result<std::vector<fs::path>> files_below(const fs::path& path, const Progress& progress,
                                          FileListing listing) {
  std::error_code error;
  if (!fs::exists(path, error)) return fail(ErrorKind::input, "{}: no such file or folder", path.string());
  if (!fs::is_directory(path, error)) return std::vector<fs::path>{path};
  std::vector<fs::path> files;
  const auto options =
      listing.skip_denied ? fs::directory_options::skip_permission_denied : fs::directory_options::none;
  fs::recursive_directory_iterator entries(path, options, error);
  for (; !error && entries != fs::recursive_directory_iterator(); entries.increment(error)) {
    if (progress.cancelled()) return cancelled_error();
    const bool is_unfinished = !AtomicFile::target_of(entries->path()).empty();
    if (!listing.recursive || is_unfinished) entries.disable_recursion_pending();
    std::error_code ignored;
    if (!is_unfinished && entries->is_regular_file(ignored)) files.push_back(entries->path());
  }
  if (error) return fail(ErrorKind::input, "{}: cannot be listed: {}", path.string(), error.message());
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace tidemark
