// The audit log of a program: every event becomes a message, which is kept until it is delivered.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>

#include "imaging/audit/configuration.h"
#include "imaging/audit/destination.h"
#include "imaging/audit/event.h"
#include "imaging/audit/message.h"
#include "imaging/audit/spool.h"

namespace tidemark::imaging {

// A message is first written to the spool, so that it outlives the program, however that ends. A thread of
// the log's delivers what waits there, oldest first, also what other programs of the user have left. One
// program at a time delivers.
class AuditLog final : public AuditSink {
 public:
  // Gets a sentence for the user: once when messages begin to wait for their destination, and once when one
  // is lost. It is called on any thread.
  using Tell = std::function<void(const Error& notice)>;

  // Records the start of the program. Fails naming what is not usable: a file of the configuration, or the
  // spool, user_state_folder()/audit.
  static Result<std::shared_ptr<AuditLog>> start(const AuditConfiguration& configuration,
                                                 const std::string& program, Tell tell);
  // By the configuration that there is. Null: there is none, and nothing is audited.
  static Result<std::shared_ptr<AuditLog>> start_if_wanted(const std::string& program, Tell tell);
  ~AuditLog() override;

  // Waits for no delivery. An event that concerns nobody's study is none.
  void take(const AuditEvent& event) override;

  // Records the end of the program, waits until nothing waits, the destination has failed, `patience` is over
  // or a stop is requested, and ends the deliveries. Returns how many messages wait, and why.
  struct Left {
    std::size_t messages = 0;
    std::string reason;
  };
  Left finish(std::chrono::milliseconds patience, const std::stop_token& stop = {});

 private:
  AuditLog(const AuditConfiguration& configuration, const std::string& program, AuditSpool spool,
           std::unique_ptr<AuditDestination> destination, Tell tell);
  void deliver(const std::stop_token& stop);
  bool deliver_all(const std::stop_token& stop);
  bool set_aside(const std::filesystem::path& file, const Error& reason);
  void note_failure(const Error& error);
  void wake() const;

  AuditOrigin origin_;
  const AuditSpool spool_;
  const std::unique_ptr<AuditDestination> destination_;
  const Tell tell_;
  int bell_ = -1;  // an eventfd: a copy of this process can ring it, too

  std::mutex mutex_;  // guards what follows
  std::condition_variable changed_;
  std::string reason_;    // of the last failure to deliver; empty: none since the last success
  bool is_told_ = false;  // that messages wait
  bool is_finishing_ = false;
  bool has_tried_ = false;  // once all was recorded
  std::atomic<bool> has_lost_ = false;
  std::jthread thread_;  // last: it uses the others
};

}  // namespace tidemark::imaging
