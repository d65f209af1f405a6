#include "tests/support/child_process.h"

#include <fcntl.h>
#include <linux/capability.h>
#include <poll.h>
#include <signal.h>
#include <sys/inotify.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <QtGlobal>
#include <array>
#include <cerrno>
#include <fstream>

namespace tidemark::test {
namespace {

void limit_memory(std::int64_t more) {
  std::int64_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  const auto bytes = static_cast<rlim_t>(pages * ::sysconf(_SC_PAGESIZE) + more);
  const rlimit most{bytes, bytes};
  if (pages == 0 || setrlimit(RLIMIT_AS, &most) != 0) ::_exit(2);
}

[[noreturn]] void work_as_child(const std::function<Status()>& work, const Disturbance& disturbance,
                                int out) {
  // Libraries print on standard error what is in the work's Status too.
  const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  ::dup2(nowhere, STDERR_FILENO);
  if (disturbance.largest_file) {
    ::signal(SIGXFSZ, disturbance.is_fatal ? SIG_DFL : SIG_IGN);
    const rlimit none{0, 0};
    setrlimit(RLIMIT_CORE, &none);
    const auto bytes = static_cast<rlim_t>(*disturbance.largest_file);
    const rlimit most{bytes, bytes};
    setrlimit(RLIMIT_FSIZE, &most);
  }
  if (disturbance.more_memory) limit_memory(*disturbance.more_memory);
  const Status done = work();
  const std::string& said = done ? std::string() : done.error().message;
  if (::write(out, said.data(), said.size()) < 0) ::_exit(2);
  ::_exit(done ? 0 : 1);
}

// How many events there are to be read.
int take_events(int notifier) {
  alignas(inotify_event) std::array<char, 1 << 16> buffer;
  const ssize_t got = ::read(notifier, buffer.data(), buffer.size());
  int events = 0;
  for (ssize_t at = 0; at < got; ++events) {
    const auto* event = reinterpret_cast<const inotify_event*>(buffer.data() + at);
    at += static_cast<ssize_t>(sizeof(inotify_event) + event->len);
  }
  return events;
}

// Reads the child's messages until it has ended, and kills it at its event.
std::string attend(pid_t child, int in, int notifier, int events) {
  std::string said;
  std::array<char, 4096> buffer;
  std::array<pollfd, 2> awaited{{{in, POLLIN, 0}, {notifier, POLLIN, 0}}};
  while (true) {
    if (::poll(awaited.data(), awaited.size(), -1) < 0 && errno != EINTR) qFatal("cannot wait for a child");
    if ((awaited[1].revents & POLLIN) != 0 && events > 0) {
      events -= take_events(notifier);
      if (events <= 0) ::kill(child, SIGKILL);
    }
    if (awaited[0].revents == 0) continue;
    const ssize_t got = ::read(in, buffer.data(), buffer.size());
    if (got <= 0) return said;
    said.append(buffer.data(), static_cast<std::size_t>(got));
  }
}

}  // namespace

void give_up_privileges() {
  __user_cap_header_struct head{_LINUX_CAPABILITY_VERSION_3, 0};
  constexpr std::array<__user_cap_data_struct, _LINUX_CAPABILITY_U32S_3> kNone{};
  const bool none_are_left =
      ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 && ::syscall(SYS_capset, &head, kNone.data()) == 0;
  if (!none_are_left) ::_exit(2);
}

Ended run_in_child(const std::function<Status()>& work, const Disturbance& disturbance) {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) qFatal("cannot make a pipe");
  int notifier = -1;
  if (disturbance.events > 0) {
    notifier = ::inotify_init1(IN_CLOEXEC);
    constexpr std::uint32_t kSteps = IN_CREATE | IN_CLOSE_WRITE | IN_MOVE | IN_DELETE;
    if (::inotify_add_watch(notifier, disturbance.watched.c_str(), kSteps) < 0) qFatal("cannot watch");
  }
  const pid_t child = ::fork();
  if (child < 0) qFatal("cannot fork");
  if (child == 0) work_as_child(work, disturbance, ends[1]);
  ::close(ends[1]);
  Ended ended;
  ended.failure = attend(child, ends[0], notifier, disturbance.events);
  ::close(ends[0]);
  if (notifier >= 0) ::close(notifier);
  int status = 0;
  if (::waitpid(child, &status, 0) != child) qFatal("a child is lost");
  ended.was_killed = WIFSIGNALED(status);
  // Anything but these two is a crash.
  const int wanted = disturbance.largest_file ? SIGXFSZ : SIGKILL;
  if (ended.was_killed && WTERMSIG(status) != wanted) qFatal("a child died of signal %d", WTERMSIG(status));
  if (!ended.was_killed && (WEXITSTATUS(status) != 0) != !ended.failure.empty()) qFatal("a child failed");
  return ended;
}

}  // namespace tidemark::test
