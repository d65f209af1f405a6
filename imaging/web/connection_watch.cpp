#include "imaging/web/connection_watch.h"

#include <sys/socket.h>

#include <utility>

#include "core/progress.h"

namespace tidemark::imaging {
namespace {

using namespace std::chrono_literals;

constexpr std::int64_t kLeastBytes = std::int64_t{64} << 10;
constexpr std::chrono::milliseconds kLook = 50ms;

}  // namespace

ConnectionWatch::ConnectionWatch(std::string peer, std::chrono::milliseconds patience, std::stop_token stop)
    : peer_(std::move(peer)), stop_(std::move(stop)), patience_(patience) {
  watcher_ = std::jthread([this](const std::stop_token& quit) { watch(quit); });
}

ConnectionWatch::~ConnectionWatch() {
  watcher_.request_stop();
  watcher_.join();
}

void ConnectionWatch::watch(const std::stop_token& quit) {
  std::unique_lock lock(mutex_);
  while (!quit.stop_requested()) {
    quit_.wait_for(lock, quit, kLook, [] { return false; });
    if (trouble_ || socket_ < 0) continue;
    if (stop_.stop_requested()) {
      shut_locked(cancelled_error().value());
      continue;
    }
    if (!waiting_since_) continue;
    if (waited_ + (Clock::now() - *waiting_since_) > patience_) {
      const double seconds = std::chrono::duration<double>(patience_).count();
      const std::string what = came_ == 0 ? fmt::format("does not answer: nothing came for {:.0f} s", seconds)
                                          : fmt::format("is too slow: {} bytes in {:.0f} s", came_, seconds);
      shut_locked({ErrorKind::input, fmt::format("{}: {}", peer_, what)});
    }
  }
}

void ConnectionWatch::opened(int socket) {
  const std::lock_guard lock(mutex_);
  socket_ = socket;
  if (trouble_) ::shutdown(socket_, SHUT_RDWR);
}

void ConnectionWatch::closing() {
  const std::lock_guard lock(mutex_);
  socket_ = -1;
}

void ConnectionWatch::begin_wait() {
  const std::lock_guard lock(mutex_);
  waiting_since_ = Clock::now();
}

void ConnectionWatch::end_wait() {
  const std::lock_guard lock(mutex_);
  if (waiting_since_) waited_ += Clock::now() - *waiting_since_;
  waiting_since_.reset();
}

void ConnectionWatch::moved(std::int64_t bytes) {
  moved_ += bytes;
  if (moved_ >= kLeastBytes) start_anew();
}

void ConnectionWatch::start_anew() {
  moved_ = 0;
  came_ = 0;
  waited_ = 0s;
  if (waiting_since_) waiting_since_ = Clock::now();  // a wait may span many messages
}

void ConnectionWatch::sent(std::int64_t bytes) {
  const std::lock_guard lock(mutex_);
  moved(bytes);
}

bool ConnectionWatch::received(std::int64_t bytes) {
  const std::lock_guard lock(mutex_);
  came_ += bytes;
  moved(bytes);
  allowed_ -= bytes;
  if (allowed_ < 0) {
    shut_locked({ErrorKind::input, fmt::format("{}: sends more than {} may hold", peer_, what_)});
  }
  return !trouble_;
}

void ConnectionWatch::allow(std::int64_t bytes, std::string what) {
  const std::lock_guard lock(mutex_);
  allowed_ = bytes;
  what_ = std::move(what);
}

void ConnectionWatch::completed_message() {
  const std::lock_guard lock(mutex_);
  start_anew();
}

void ConnectionWatch::set_patience(std::chrono::milliseconds patience) {
  const std::lock_guard lock(mutex_);
  patience_ = patience;
}

void ConnectionWatch::shut(Error reason) {
  const std::lock_guard lock(mutex_);
  shut_locked(std::move(reason));
}

void ConnectionWatch::shut_locked(Error reason) {
  if (trouble_) return;
  trouble_ = std::move(reason);
  if (socket_ >= 0) ::shutdown(socket_, SHUT_RDWR);
}

Status ConnectionWatch::trouble() const {
  const std::lock_guard lock(mutex_);
  if (trouble_) return tl::unexpected<Error>(*trouble_);
  return {};
}

}  // namespace tidemark::imaging
