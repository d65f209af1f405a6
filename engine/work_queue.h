// Pieces of work on a thread of their own, one after the other, for an object on the thread of the user
// interface.
#pragma once

#include <chrono>
#include <functional>
#include <memory>

#include "core/progress.h"
#include "core/result.h"

class QObject;

namespace tidemark::engine {

// All that was asked for is done, in its order, also after the queue is gone: the program waits for it at its
// end, as for every BackgroundJob. `ended` is called on the receiver's thread, while the queue is there.
class WorkQueue {
 public:
  using Work = std::function<Status(const Progress&)>;
  using Ended = std::function<void(const Status&)>;

  explicit WorkQueue(QObject* receiver);
  ~WorkQueue();
  WorkQueue(const WorkQueue&) = delete;
  WorkQueue& operator=(const WorkQueue&) = delete;

  // The work must hold nothing of the receiver's.
  void add(Work work, Ended ended);
  // Asks the piece that runs to stop.
  void stop_present();
  // Whether all is done now, or within that time.
  bool wait(std::chrono::milliseconds limit);

 private:
  struct Shared;

  void start();

  std::shared_ptr<Shared> shared_;
};

}  // namespace tidemark::engine
