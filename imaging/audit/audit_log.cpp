#include "imaging/audit/audit_log.h"

#include <fcntl.h>
#include <poll.h>
#include <pthread.h>
#include <signal.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <utility>

#include "core/file_lock.h"
#include "core/text_file.h"
#include "core/user_folders.h"
#include "core/without_exceptions.h"
#include "imaging/audit/syslog_frame.h"

namespace tidemark::imaging {
namespace {

namespace fs = std::filesystem;
using Milliseconds = std::chrono::milliseconds;

constexpr Milliseconds kFirstPause(1000);  // after a failure; it doubles
constexpr Milliseconds kLongestPause(60'000);
constexpr Milliseconds kLookAgain(200);         // at what another program delivers
constexpr Milliseconds kUntilNextLook(30'000);  // at what another program has left
constexpr const char* kDamaged = ".damaged";
constexpr std::size_t kLongestMessage = std::size_t{1} << 16;

// Signals are for other threads; a peer that hangs up must not end the program.
void block_signals() {
  sigset_t all;
  sigfillset(&all);
  ::pthread_sigmask(SIG_BLOCK, &all, nullptr);
}

}  // namespace

Result<std::shared_ptr<AuditLog>> AuditLog::start(const AuditConfiguration& configuration,
                                                  const std::string& program, Tell tell) {
  auto destination = AuditDestination::open(configuration);
  if (!destination) return pass_on(destination);
  auto spool = AuditSpool::open(user_state_folder() / "audit", configuration.waiting);
  if (!spool) return pass_on(spool);
  std::shared_ptr<AuditLog> log(
      new AuditLog(configuration, program, std::move(*spool), std::move(*destination), std::move(tell)));
  log->take({.kind = AuditEvent::Kind::started});
  return log;
}

Result<std::shared_ptr<AuditLog>> AuditLog::start_if_wanted(const std::string& program, Tell tell) {
  const auto file = audit_configuration_to_read();
  if (!file) return std::shared_ptr<AuditLog>();
  const auto configuration = read_audit_configuration(*file);
  if (!configuration) return pass_on(configuration);
  return start(*configuration, program, std::move(tell));
}

AuditLog::AuditLog(const AuditConfiguration& configuration, const std::string& program, AuditSpool spool,
                   std::unique_ptr<AuditDestination> destination, Tell tell)
    : origin_(AuditOrigin::of_this_process(program)),
      spool_(std::move(spool)),
      destination_(std::move(destination)),
      tell_(std::move(tell)),
      bell_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)),
      thread_([this](const std::stop_token& stop) {
        block_signals();
        deliver(stop);
      }) {
  origin_.site = configuration.site;
  if (!configuration.source.empty()) origin_.source = configuration.source;
}

AuditLog::~AuditLog() {
  finish(Milliseconds(0));
  ::close(bell_);
}

void AuditLog::wake() const {
  constexpr std::uint64_t kOne = 1;
  static_cast<void>(!::write(bell_, &kOne, sizeof kOne));
}

void AuditLog::take(const AuditEvent& event) {
  using Kind = AuditEvent::Kind;
  const bool is_of_a_study =
      event.kind != Kind::started && event.kind != Kind::stopped && event.kind != Kind::queried;
  if (is_of_a_study && !event.study.is_known()) return;
  const Status kept = without_exceptions([&] { return spool_.add(syslog_message(event, origin_)); });
  if (!kept && !has_lost_.exchange(true) && tell_) tell_(kept.error());
  wake();
}

void AuditLog::deliver(const std::stop_token& stop) {
  const std::stop_callback ring(stop, [this] { wake(); });
  Milliseconds pause = kFirstPause;
  while (!stop.stop_requested()) {
    std::uint64_t rings = 0;
    static_cast<void>(!::read(bell_, &rings, sizeof rings));
    bool is_finishing = false;
    {
      const std::lock_guard lock(mutex_);
      is_finishing = is_finishing_;
    }
    const auto all_went = without_exceptions([&]() -> Result<bool> { return deliver_all(stop); });
    if (!all_went) note_failure(all_went.error());
    bool failed = false;
    {
      const std::lock_guard lock(mutex_);
      has_tried_ = is_finishing;
      failed = !reason_.empty();
    }
    changed_.notify_all();
    if (!failed) pause = kFirstPause;
    // While the server is away, new messages do not make it be called more often.
    const Milliseconds until = all_went.value_or(false) ? kUntilNextLook : failed ? pause : kLookAgain;
    const auto end = std::chrono::steady_clock::now() + until;
    do {
      const auto left = std::chrono::ceil<Milliseconds>(end - std::chrono::steady_clock::now());
      pollfd bell{bell_, POLLIN, 0};
      if (::poll(&bell, 1, static_cast<int>(std::max<std::int64_t>(left.count(), 0))) <= 0) break;
      const std::lock_guard lock(mutex_);
      if (!failed || is_finishing_ || stop.stop_requested()) break;
      static_cast<void>(!::read(bell_, &rings, sizeof rings));
    } while (true);
    if (failed) pause = std::min(2 * pause, kLongestPause);
  }
}

// False where messages are left: the destination has failed, or another program delivers.
bool AuditLog::deliver_all(const std::stop_token& stop) {
  for (;;) {
    if (spool_.waiting().empty()) return true;
    const FileLock lock = FileLock::take(spool_.folder() / "lock", FileLock::Missing::make);
    if (!lock) return false;
    for (const fs::path& file : spool_.waiting()) {
      if (stop.stop_requested()) return false;
      const auto message = read_text_file(file, kLongestMessage);
      if (!message) {
        if (!set_aside(file, message.error())) return false;
        continue;
      }
      if (const Status delivered = destination_->deliver(*message, stop); !delivered) {
        if (!stop.stop_requested()) note_failure(delivered.error());
        return false;
      }
      std::error_code ignored;
      fs::remove(file, ignored);
      const std::lock_guard guard(mutex_);
      reason_.clear();
    }
    const std::lock_guard guard(mutex_);
    is_told_ = false;
  }
}

// What cannot be read stays in the folder, and holds up no other message. False where it cannot be renamed.
bool AuditLog::set_aside(const fs::path& file, const Error& reason) {
  std::error_code failed;
  fs::rename(file, file.string() + kDamaged, failed);
  if (failed) {
    note_failure(reason);
    return false;
  }
  if (tell_)
    tell_({ErrorKind::input,
           fmt::format("an audit message cannot be read and is kept beside the others: {}", reason.message)});
  return true;
}

void AuditLog::note_failure(const Error& error) {
  const std::size_t waiting = spool_.waiting().size();
  bool is_new = false;
  {
    const std::lock_guard lock(mutex_);
    reason_ = error.message;
    is_new = !std::exchange(is_told_, true);
  }
  if (!is_new || !tell_) return;
  tell_({ErrorKind::input, fmt::format("{} audit messages wait: {}", waiting, error.message)});
}

AuditLog::Left AuditLog::finish(Milliseconds patience, const std::stop_token& stop) {
  if (!thread_.joinable()) return {};
  take({.kind = AuditEvent::Kind::stopped});
  const auto end = std::chrono::steady_clock::now() + patience;
  std::unique_lock lock(mutex_);
  is_finishing_ = true;
  wake();
  const auto is_done = [&] { return has_tried_ && (!reason_.empty() || spool_.waiting().empty()); };
  while (!is_done() && !stop.stop_requested() && std::chrono::steady_clock::now() < end) {
    changed_.wait_for(lock, Milliseconds(20));
  }
  Left left{0, reason_};
  lock.unlock();
  thread_.request_stop();
  thread_.join();
  left.messages = spool_.waiting().size();
  return left;
}

}  // namespace tidemark::imaging
