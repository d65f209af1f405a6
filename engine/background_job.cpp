#include "engine/background_job.h"

#include <QCoreApplication>
#include <condition_variable>
#include <mutex>
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

bool BackgroundJob::finish_all(std::chrono::milliseconds limit) {
  std::unique_lock lock(running().mutex);
  return running().ended.wait_for(lock, limit, [] { return running().count == 0; });
}

}  // namespace tidemark
