#include "imaging/audit/spool.h"

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>

#include "core/atomic_file.h"
#include "core/user_folders.h"

namespace tidemark::imaging {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSuffix = ".msg";

// Later than every number that this process has given before: the clock may be put back.
std::int64_t next_number() {
  static std::atomic<std::int64_t> last = 0;
  using std::chrono::microseconds, std::chrono::system_clock;
  const std::int64_t now =
      std::chrono::duration_cast<microseconds>(system_clock::now().time_since_epoch()).count();
  std::int64_t before = last;
  std::int64_t next = 0;
  do {
    next = std::max(now, before + 1);
  } while (!last.compare_exchange_weak(before, next));
  return next;
}

}  // namespace

Result<AuditSpool> AuditSpool::open(const fs::path& folder, std::size_t most) {
  TIDEMARK_TRY(make_private_folder(folder));
  return AuditSpool(folder, most);
}

Status AuditSpool::add(const std::string& message) const {
  if (waiting().size() >= most_) {
    return fail(ErrorKind::capability, "{}: {} audit messages wait, and no more are kept: they are lost",
                folder_.string(), most_);
  }
  return write_file(folder_ / fmt::format("{:020}-{}{}", next_number(), ::getpid(), kSuffix), message);
}

std::vector<fs::path> AuditSpool::waiting() const {
  std::vector<fs::path> files;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_, error)) {
    const fs::path& file = entry.path();
    if (file.extension() == kSuffix && AtomicFile::target_of(file).empty()) files.push_back(file);
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace tidemark::imaging
