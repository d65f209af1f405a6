#include "engine/background_job.h"

#include <QCoreApplication>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "core/without_exceptions.h"

namespace tidemark::engine {
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

void begin_one() {
  const std::lock_guard lock(running().mutex);
  ++running().count;
}

void end_one() {
  const std::lock_guard lock(running().mutex);
  --running().count;
  running().ended.notify_all();
}

void finish_at_exit() {
  BackgroundJob::finish_all(5s);
}

}  // namespace

bool BackgroundJob::any_running() {
  const std::lock_guard lock(running().mutex);
  return running().count > 0;
}

std::shared_ptr<BackgroundJob> BackgroundJob::start(QObject* receiver, Work work, CutOff cut_off) {
  static std::once_flag registered;
  std::call_once(registered, [] { qAddPostRoutine(finish_at_exit); });
  std::shared_ptr<BackgroundJob> job(new BackgroundJob(receiver));
  begin_one();
  const auto tell = [cut_off = std::move(cut_off)](BackgroundJob& ended, const Error& error) {
    if (cut_off) ended.deliver([cut_off, error] { cut_off(error); });
  };
  const Status started = without_exceptions([&]() -> Status {
    std::thread([job, work = std::move(work), tell]() mutable {
      const Status done = without_exceptions([&]() -> Status {
        work(*job);
        return {};
      });
      if (!done) tell(*job, done.error());
      work = nullptr;  // with all that it holds, before the job counts as ended
      job.reset();
      end_one();
    }).detach();
    return {};
  });
  if (!started) {
    end_one();
    tell(*job, started.error());
  }
  return job;
}

bool BackgroundJob::finish_all(std::chrono::milliseconds limit) {
  std::unique_lock lock(running().mutex);
  return running().ended.wait_for(lock, limit, [] { return running().count == 0; });
}

}  // namespace tidemark::engine
