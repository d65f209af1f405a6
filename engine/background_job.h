// Work on a thread of its own, for an object on the thread of the user interface.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <stop_token>

#include "core/result.h"
#include "engine/weak_receiver.h"

namespace tidemark::engine {

// The thread of the user interface never waits for such work: it abandons work whose result is no longer
// wanted. The work's thread then ends when it next looks at its stop token, and its calls until then are
// dropped. At the end of the program, QCoreApplication's destructor gives those that still run a few seconds.
class BackgroundJob {
 public:
  using Work = std::function<void(BackgroundJob&)>;

  // Starts `work`, which must hold nothing that the receiver owns. What it throws ends it alone: `cut_off` is
  // then called with the error, on the receiver's thread unless the job is abandoned by then. So it is where
  // no thread can be had.
  using CutOff = std::function<void(const Error&)>;
  static std::shared_ptr<BackgroundJob> start(QObject* receiver, Work work, CutOff cut_off = {});

  // Asks the work to stop; its last call is still delivered.
  void request_stop() { stop_.request_stop(); }
  // On the receiver's thread, at the latest in its destructor: asks the work to stop; no call is delivered
  // any more.
  void abandon() {
    stop_.request_stop();
    weak_receiver_->close();
  }

  // From the work: calls `call` on the receiver's thread, unless the job is abandoned by then.
  void deliver(std::function<void()> call) { weak_receiver_->send(std::move(call)); }
  [[nodiscard]] std::stop_token stop() const { return stop_.get_token(); }

  [[nodiscard]] static bool any_running();
  // Waits until no job runs; false when some still do after `limit`.
  static bool finish_all(std::chrono::milliseconds limit);

 private:
  explicit BackgroundJob(QObject* receiver) : weak_receiver_(WeakReceiver::of(receiver)) {}

  std::stop_source stop_;
  std::shared_ptr<WeakReceiver> weak_receiver_;
};

}  // namespace tidemark::engine
