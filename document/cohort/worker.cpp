#include "document/cohort/worker.h"

#include <fcntl.h>
#include <malloc.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <system_error>
#include <utility>

#include "core/without_exceptions.h"

namespace tidemark::cohort {
namespace {

constexpr std::size_t kLongestMessage = 3072;  // bytes: with its head less than a pipe takes at once

// What RLIMIT_DATA counts of this process: private memory that can be written to.
std::int64_t data_bytes() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    constexpr std::string_view kField = "VmData:";
    if (line.starts_with(kField)) return std::strtoll(line.c_str() + kField.size(), nullptr, 10) * 1024;
  }
  return 0;
}

void limit_memory(std::int64_t memory_bytes) {
  const auto most = static_cast<rlim_t>(data_bytes() + memory_bytes);
  const rlimit limit{most, most};
  ::setrlimit(RLIMIT_DATA, &limit);
}

// Requests to stop reach all processes of a terminal or of a scheduler's job. The parent answers them, and
// ends the copy: a copy that ended by itself would look like a case that fails. Other signals end it at once.
void reset_signals() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) ::signal(signal, SIG_IGN);
  for (const int signal : {SIGUSR1, SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL}) ::signal(signal, SIG_DFL);
  sigset_t none;
  sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
}

// What libraries print has no reader.
void silence() {
  const int nowhere = ::open("/dev/null", O_RDWR | O_CLOEXEC);
  if (nowhere < 0) return;
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) ::dup2(nowhere, descriptor);
}

// Memory that one case gives back is at hand for the next: small ones spend much of their time on that
// otherwise.
void keep_memory() {
  constexpr int kKept = 64 << 20;     // bytes
  constexpr int kLargest = 32 << 20;  // more is refused
  ::mallopt(M_TRIM_THRESHOLD, kKept);
  ::mallopt(M_MMAP_THRESHOLD, kLargest);
}

// A page table's notes of what was touched. A process that may not be dumped can write to them, but only root
// can open them then.
int open_notes() {
  return ::open("/proc/self/clear_refs", O_WRONLY | O_CLOEXEC);
}

// The peak is then that of the next piece of work.
void forget_peak(int notes) {
  if (notes >= 0) static_cast<void>(!::write(notes, "5", 1));
}

// All of it, or false at the pipe's end.
bool read_all(int pipe, void* bytes, std::size_t size) {
  auto* at = static_cast<char*>(bytes);
  while (size > 0) {
    const ssize_t got = ::read(pipe, at, size);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return false;
    at += got;
    size -= static_cast<std::size_t>(got);
  }
  return true;
}

// An answer: its length and kind (kGood, or that of an error), then the error's message.
constexpr std::int32_t kGood = -1;
struct AnswerHead {
  std::int32_t size = 0;
  std::int32_t kind = kGood;
};

bool tell(int pipe, const Status& done) {
  AnswerHead head;
  std::string message;
  if (!done) {
    message = done.error().message.substr(0, kLongestMessage);
    head = {static_cast<std::int32_t>(message.size()), static_cast<std::int32_t>(done.error().kind)};
  }
  // One write, which a pipe takes as a whole.
  std::string bytes(reinterpret_cast<const char*>(&head), sizeof head);
  bytes += message;
  return ::write(pipe, bytes.data(), bytes.size()) == static_cast<ssize_t>(bytes.size());
}

[[noreturn]] void run_copy(const std::function<Status(const WorkRequest&)>& work, std::int64_t memory_bytes,
                           pid_t parent, int requests, int answers) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(1);  // it has ended before
  const int notes = open_notes();
  // A dump of memory would hold the patient's images, and take as long as the case.
  ::prctl(PR_SET_DUMPABLE, 0);
  reset_signals();
  silence();
  if (memory_bytes > 0) limit_memory(memory_bytes);
  keep_memory();
  for (WorkRequest request; read_all(requests, &request, sizeof request);) {
    forget_peak(notes);
    if (!tell(answers, without_exceptions([&] { return work(request); }))) break;
  }
  ::_exit(0);
}

std::string describe(int status) {
  if (!WIFSIGNALED(status)) return fmt::format("ended with code {}", WEXITSTATUS(status));
  const int signal = WTERMSIG(status);
  return fmt::format("ended by signal {} ({})", signal, ::strsignal(signal));
}

tl::unexpected<Error> no_process() {
  return fail(ErrorKind::capability, "no process can be started: {}", std::generic_category().message(errno));
}

}  // namespace

Result<Worker> Worker::start(const std::function<Status(const WorkRequest&)>& work,
                             std::int64_t memory_bytes) {
  int requests[2];
  int answers[2];
  if (::pipe2(requests, O_CLOEXEC) != 0) return no_process();
  Worker worker;
  worker.requests_ = requests[1];
  if (::pipe2(answers, O_CLOEXEC) != 0) {
    const auto failed = no_process();
    ::close(requests[0]);
    return failed;
  }
  worker.answers_ = answers[0];
  std::fflush(nullptr);  // or the copy would write it once more
  const pid_t parent = ::getpid();
  const pid_t process = ::fork();
  if (process == 0) {
    ::close(requests[1]);
    ::close(answers[0]);
    run_copy(work, memory_bytes, parent, requests[0], answers[1]);
  }
  const auto failed = no_process();
  ::close(requests[0]);
  ::close(answers[1]);
  if (process < 0) return failed;
  worker.process_ = process;
  return worker;
}

Worker::Worker(Worker&& other) noexcept
    : process_(std::exchange(other.process_, -1)),
      requests_(std::exchange(other.requests_, -1)),
      answers_(std::exchange(other.answers_, -1)),
      served_(other.served_),
      killed_(other.killed_) {}

Worker& Worker::operator=(Worker&& other) noexcept {
  std::swap(process_, other.process_);
  std::swap(requests_, other.requests_);
  std::swap(answers_, other.answers_);
  std::swap(served_, other.served_);
  std::swap(killed_, other.killed_);
  return *this;
}

Worker::~Worker() {
  if (process_ > 0) {
    kill();
    end();
  }
  close();
}

void Worker::close() {
  for (int* descriptor : {&requests_, &answers_}) {
    if (*descriptor >= 0) ::close(std::exchange(*descriptor, -1));
  }
}

void Worker::send(const WorkRequest& request) {
  ++served_;
  static_cast<void>(!::write(requests_, &request, sizeof request));
}

void Worker::kill() {
  killed_ = true;
  if (process_ > 0) ::kill(process_, SIGKILL);
}

WorkEnd Worker::answer() {
  AnswerHead head;
  if (!read_all(answers_, &head, sizeof head)) return end();
  if (head.kind == kGood) return {true, {}, false, 0};
  std::string message(static_cast<std::size_t>(head.size), '\0');
  if (!read_all(answers_, message.data(), message.size())) return end();
  return {false, {static_cast<ErrorKind>(head.kind), std::move(message)}, false, 0};
}

// Of a process that ends, or has ended.
WorkEnd Worker::end() {
  int status = 0;
  rusage usage{};
  while (::wait4(process_, &status, 0, &usage) < 0 && errno == EINTR) {
  }
  process_ = -1;
  WorkEnd end;
  end.error = {ErrorKind::internal, describe(status)};
  end.killed = WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL && !killed_;
  end.peak_memory_bytes = static_cast<std::int64_t>(usage.ru_maxrss) * 1024;
  return end;
}

}  // namespace tidemark::cohort
