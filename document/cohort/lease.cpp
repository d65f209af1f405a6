#include "document/cohort/lease.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <climits>
#include <fstream>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "core/number_from.h"
#include "core/text_file.h"

namespace tidemark::cohort {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLargestLease = 4096;  // bytes
constexpr int kMostFollowers = 1'000'000;

fs::path lease_file(const fs::path& folder, const std::string& id, int number) {
  return folder / fmt::format("{}.{}", id, number);
}

std::string first_line(const char* file) {
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line);
  return line;
}

// When a process began, in ticks since the machine did; empty: that cannot be read. With it a process is told
// from a later one of the same number.
std::string start_of(long process) {
  const std::string stat = first_line(fmt::format("/proc/{}/stat", process).c_str());
  const std::size_t name_end = stat.rfind(')');  // a name may hold blanks and brackets
  if (name_end == std::string::npos) return {};
  std::size_t at = name_end;
  constexpr int kStartField = 20;  // counted from the name
  for (int field = 0; field < kStartField && at != std::string::npos; ++field) at = stat.find(' ', at + 1);
  if (at == std::string::npos) return {};
  return stat.substr(at + 1, stat.find(' ', at + 1) - at - 1);
}

// Three lines: the machine, the process, and when it began.
std::string holder_text() {
  return fmt::format("{}\n{}\n{}\n", this_machine(), ::getpid(), start_of(::getpid()));
}

// Whether the holder was a process of this machine that has ended. What cannot be read says nothing.
bool holder_has_ended(const fs::path& file) {
  const auto text = read_text_file(file, kLargestLease);
  if (!text) return false;
  const std::size_t first = text->find('\n');
  const std::size_t second = text->find('\n', first == std::string::npos ? first : first + 1);
  if (second == std::string::npos || text->substr(0, first) != this_machine()) return false;
  const std::string_view number = std::string_view(*text).substr(first + 1, second - first - 1);
  const auto process = number_from<pid_t>(number);
  if (!process || *process <= 0) return false;
  if (::kill(*process, 0) != 0 && errno == ESRCH) return true;
  const std::string began = text->substr(second + 1, text->find('\n', second + 1) - second - 1);
  const std::string now = start_of(*process);  // systems may hide the processes of other users
  return !now.empty() && now != began;
}

// The same of a draft by its name: it is empty for a moment.
bool drafter_has_ended(const std::string& name) {
  const std::size_t last = name.rfind('.');
  const std::size_t before = last == 0 || last == std::string::npos ? last : name.rfind('.', last - 1);
  if (before == std::string::npos || before == 0) return false;
  const auto process = number_from<pid_t>(std::string_view(name).substr(before + 1, last - before - 1));
  const bool is_ours = name.substr(1, before - 1) == this_machine();
  return is_ours && process && *process > 0 && ::kill(*process, 0) != 0 && errno == ESRCH;
}

double seconds_of(const timespec& time) {
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

// A file of a name that nobody else has, with the holder's text. Its age is zero by the disk's clock.
class Draft {
 public:
  static Result<Draft> make(const fs::path& folder) {
    static std::atomic<int> count{0};
    Draft draft;
    draft.file_ = folder / fmt::format(".{}.{}.{}", this_machine(), ::getpid(), ++count);
    const int descriptor = ::open(draft.file_.c_str(), O_CREAT | O_TRUNC | O_WRONLY | O_CLOEXEC, 0666);
    const std::string text = holder_text();
    const bool written =
        descriptor >= 0 && ::write(descriptor, text.data(), text.size()) == static_cast<ssize_t>(text.size());
    struct stat state {};
    const bool good = written && ::fstat(descriptor, &state) == 0;
    const int error = errno;
    if (descriptor >= 0) ::close(descriptor);
    if (!good) {
      return fail(ErrorKind::write, "{}: cannot write: {}", folder.string(),
                  std::generic_category().message(error));
    }
    draft.now_ = seconds_of(state.st_mtim);
    return draft;
  }
  ~Draft() {
    if (!file_.empty()) ::unlink(file_.c_str());
  }
  Draft(Draft&& other) noexcept : file_(std::exchange(other.file_, {})), now_(other.now_) {}
  Draft& operator=(Draft&&) = delete;

  [[nodiscard]] double now() const { return now_; }

  // Returns 0 or errno. A lost answer of a network file system is no failure: the number of names says what
  // happened.
  int link_as(const fs::path& name) const {
    if (::link(file_.c_str(), name.c_str()) == 0) return 0;
    const int error = errno;
    struct stat state {};
    if (::stat(file_.c_str(), &state) == 0 && state.st_nlink == 2) return 0;
    return error;
  }

 private:
  Draft() = default;
  fs::path file_;
  double now_ = 0.0;
};

// Where the file system knows no links; returns 0 or errno.
int make_alone(const fs::path& name) {
  const int descriptor = ::open(name.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
  if (descriptor < 0) return errno;
  const std::string text = holder_text();
  const bool written = ::write(descriptor, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  return ::close(descriptor) == 0 && written ? 0 : EIO;
}

bool is_free(const fs::path& file, double now, double stale_after_s) {
  struct stat state {};
  if (::stat(file.c_str(), &state) != 0) return false;
  return now - seconds_of(state.st_mtim) > stale_after_s || holder_has_ended(file);
}

bool file_is_there(const fs::path& file) {
  return ::access(file.c_str(), F_OK) == 0;
}

// The number that the next holder would have; 0: the case is held.
int next_number(const fs::path& folder, const std::string& id, double now, double stale_after_s) {
  int number = 0;
  while (number < kMostFollowers && file_is_there(lease_file(folder, id, number + 1))) ++number;
  if (number == 0) return 1;
  return is_free(lease_file(folder, id, number), now, stale_after_s) ? number + 1 : 0;
}

}  // namespace

Result<std::optional<Lease>> Lease::take(const fs::path& folder, const std::string& id,
                                         double stale_after_s) {
  const auto draft = Draft::make(folder);
  if (!draft) return pass_on(draft);
  const int number = next_number(folder, id, draft->now(), stale_after_s);
  if (number == 0) return std::nullopt;
  const fs::path file = lease_file(folder, id, number);
  int error = draft->link_as(file);
  if (error == EPERM || error == EOPNOTSUPP || error == ENOSYS) error = make_alone(file);
  if (error == EEXIST) return std::nullopt;
  if (error != 0) {
    return fail(ErrorKind::write, "{}: cannot write: {}", file.string(),
                std::generic_category().message(error));
  }
  Lease lease;
  lease.folder_ = folder;
  lease.id_ = id;
  lease.number_ = number;
  return lease;
}

Lease::Lease(Lease&& other) noexcept
    : folder_(std::move(other.folder_)),
      id_(std::move(other.id_)),
      number_(std::exchange(other.number_, 0)) {}

Lease& Lease::operator=(Lease&& other) noexcept {
  std::swap(folder_, other.folder_);
  std::swap(id_, other.id_);
  std::swap(number_, other.number_);
  return *this;
}

// Not removed: who has seen an earlier one age out may be about to make this number.
Lease::~Lease() {
  if (number_ == 0 || !held()) return;
  const timespec long_ago[2] = {{1, 0}, {1, 0}};
  ::utimensat(AT_FDCWD, lease_file(folder_, id_, number_).c_str(), long_ago, 0);
}

bool Lease::held() const {
  return number_ != 0 && file_is_there(lease_file(folder_, id_, number_)) &&
         !file_is_there(lease_file(folder_, id_, number_ + 1));
}

void Lease::refresh() const {
  ::utimensat(AT_FDCWD, lease_file(folder_, id_, number_).c_str(), nullptr, 0);
}

void Lease::finish() {
  for (int number = std::exchange(number_, 0); number > 0; --number) {
    ::unlink(lease_file(folder_, id_, number).c_str());
  }
}

void sweep_leases(const fs::path& folder, double stale_after_s,
                  const std::function<bool(const std::string& id)>& is_done) {
  const auto draft = Draft::make(folder);
  if (!draft) return;
  std::error_code error;
  std::vector<fs::path> left;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    const bool is_draft = name.starts_with('.');
    if (!is_draft && !is_done(name.substr(0, name.rfind('.')))) continue;
    const bool ended = is_draft && drafter_has_ended(name);
    if (ended || is_free(entry->path(), draft->now(), stale_after_s)) left.push_back(entry->path());
  }
  for (const fs::path& file : left) ::unlink(file.c_str());
}

std::string this_machine() {
  static const std::string kName = [] {
    char host[HOST_NAME_MAX + 1] = {};
    ::gethostname(host, HOST_NAME_MAX);
    // Since its last start, and among the processes of one container: numbers of others mean others.
    std::error_code ignored;
    const std::string space = fs::read_symlink("/proc/self/ns/pid", ignored).string();
    const std::string start = first_line("/proc/sys/kernel/random/boot_id").substr(0, 8);
    std::string digits;
    for (const char c : space) digits += c >= '0' && c <= '9' ? std::string(1, c) : "";
    return fmt::format("{}-{}-{}", host, start, digits);
  }();
  return kName;
}

}  // namespace tidemark::cohort
