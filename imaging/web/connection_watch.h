// A watch over one connection: no peer can keep us waiting or flood us.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>

#include "core/result.h"

namespace tidemark::imaging {

// DCMTK and libcurl work with calls that block. While such a call waits, a thread of the watch looks at the
// clock: in every `patience` of waiting the peer must have sent or taken 64 KiB, or completed a message.
// Otherwise, and on a request to stop, the socket is shut down. Every blocked call then returns at once, also
// in the midst of a TLS record. A shut connection stays shut; trouble() has the reason.
class ConnectionWatch {
 public:
  // `peer` begins the messages: "PACS main (pacs.example:104)".
  ConnectionWatch(std::string peer, std::chrono::milliseconds patience, std::stop_token stop);
  ~ConnectionWatch();
  ConnectionWatch(const ConnectionWatch&) = delete;
  ConnectionWatch& operator=(const ConnectionWatch&) = delete;

  // By the transport: between these the socket is open. closing() comes before the close: the number may then
  // belong to another socket, which must not be shut down.
  void opened(int socket);
  void closing();
  // Around a blocking call.
  class Wait {
   public:
    explicit Wait(ConnectionWatch& watch) : watch_(watch) { watch_.begin_wait(); }
    ~Wait() { watch_.end_wait(); }
    Wait(const Wait&) = delete;
    Wait& operator=(const Wait&) = delete;

   private:
    ConnectionWatch& watch_;
  };
  void sent(std::int64_t bytes);
  [[nodiscard]] bool received(
      std::int64_t bytes);  // false when it is more than allowed: the connection is shut

  // By the conversation: from now on the peer may send that many bytes; `what` names them in messages.
  void allow(std::int64_t bytes, std::string what);
  void completed_message();
  void set_patience(std::chrono::milliseconds patience);

  void shut(Error reason);
  // The reason why it was shut; a success where it was not, and a failure has another reason.
  [[nodiscard]] Status trouble() const;
  [[nodiscard]] const std::string& peer() const { return peer_; }

 private:
  using Clock = std::chrono::steady_clock;
  void begin_wait();
  void end_wait();
  void watch(const std::stop_token& quit);
  void moved(std::int64_t bytes);
  void start_anew();
  void shut_locked(Error reason);

  const std::string peer_;
  const std::stop_token stop_;
  mutable std::mutex mutex_;  // guards the members below
  std::condition_variable_any quit_;
  std::chrono::milliseconds patience_;
  int socket_ = -1;
  std::optional<Clock::time_point> waiting_since_;
  Clock::duration waited_{0};  // since the last 64 KiB or message, without the wait that is under way
  std::int64_t moved_ = 0;     // bytes, since then, in both directions
  std::int64_t came_ = 0;      // bytes, since then
  std::int64_t allowed_ = 0;   // bytes
  std::string what_;
  std::optional<Error> trouble_;
  std::jthread watcher_;  // last: it uses the others
};

}  // namespace tidemark::imaging
