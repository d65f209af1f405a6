#include "session/background_job.h"

#include <QCoreApplication>
#include <condition_variable>
#include <thread>

namespace tidemark {
namespace {

using namespace std::chrono_literals;

// Never destroyed: a thread that outlives even the application's destructor still finds it.
struct Running {
  std::mutex mutex;
  std::condition_variable ended;
  int count = 0;
};

Running& running() {
  static Running& all = *new Running;
  return all;
}

void finish_at_exit() {
  BackgroundJob::finish_all(5s);
}

}  // namespace

std::shared_ptr<BackgroundJob> BackgroundJob::start(QObject* receiver, Work work) {
  static std::once_flag registered;
  std::call_once(registered, [] { qAddPostRoutine(finish_at_exit); });
  std::shared_ptr<BackgroundJob> job(new BackgroundJob(receiver));
  {
    const std::lock_guard lock(running().mutex);
    ++running().count;
  }
  std::thread([job, work = std::move(work)]() mutable {
    work(*job);
    work = nullptr;  // with all that it holds, before the job counts as ended
    job.reset();
    const std::lock_guard lock(running().mutex);
    --running().count;
    running().ended.notify_all();
  }).detach();
  return job;
}

void BackgroundJob::abandon() {
  stop_.request_stop();
  const std::lock_guard lock(mutex_);
  receiver_ = nullptr;
}

void BackgroundJob::deliver(std::function<void()> call) {
  const std::lock_guard lock(mutex_);
  if (receiver_ == nullptr) return;
  // Only the receiver's thread abandons, so that a look without the lock is enough there.
  QMetaObject::invokeMethod(
      receiver_,
      [job = shared_from_this(), call = std::move(call)] {
        if (job->receiver_ != nullptr) call();
      },
      Qt::QueuedConnection);
}

bool BackgroundJob::finish_all(std::chrono::milliseconds limit) {
  std::unique_lock lock(running().mutex);
  return running().ended.wait_for(lock, limit, [] { return running().count == 0; });
}

}  // namespace tidemark
