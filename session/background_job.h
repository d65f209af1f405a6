// Work on a thread of its own, for an object on the thread of the user interface.
#pragma once

#include <QObject>
#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <stop_token>

namespace tidemark {

// The thread of the user interface never waits for such work: whoever does not want its result any more
// abandons it. The thread then ends when it next looks at its stop token, and what it says until then is not
// heard. At the end of the program, QCoreApplication's destructor gives those that still run a few seconds.
class BackgroundJob : public std::enable_shared_from_this<BackgroundJob> {
 public:
  using Work = std::function<void(BackgroundJob&)>;

  // Starts `work`, which must hold nothing that the receiver owns, and must not throw.
  static std::shared_ptr<BackgroundJob> start(QObject* receiver, Work work);

  // On the receiver's thread, at the latest in its destructor: asks the work to stop; no call is delivered
  // any more.
  void abandon();

  // From the work: calls `call` on the receiver's thread, unless the job is abandoned by then.
  void deliver(std::function<void()> call);
  [[nodiscard]] std::stop_token stop() const { return stop_.get_token(); }

  // Waits until no job runs; false when some still do after `limit`.
  static bool finish_all(std::chrono::milliseconds limit);

 private:
  explicit BackgroundJob(QObject* receiver) : receiver_(receiver) {}

  std::stop_source stop_;
  std::mutex mutex_;  // guards receiver_: it must not go while an event is posted to it
  QObject* receiver_;
};

}  // namespace tidemark
