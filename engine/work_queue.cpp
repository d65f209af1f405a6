#include "engine/work_queue.h"

#include <QCoreApplication>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <stop_token>
#include <utility>

#include "core/without_exceptions.h"
#include "engine/background_job.h"
#include "engine/weak_receiver.h"

namespace tidemark::engine {

struct WorkQueue::Shared {
  struct Piece {
    Work work;
    Ended ended;
  };

  std::mutex mutex;
  std::condition_variable idle;
  std::deque<Piece> pieces;  // the first is being done while `runs`
  bool runs = false;
  std::stop_source present;
  std::shared_ptr<WeakReceiver> receiver;
};

WorkQueue::WorkQueue(QObject* receiver) : shared_(std::make_shared<Shared>()) {
  shared_->receiver = WeakReceiver::of(receiver);
}

WorkQueue::~WorkQueue() {
  shared_->receiver->close();
}

void WorkQueue::add(Work work, Ended ended) {
  const std::lock_guard lock(shared_->mutex);
  shared_->pieces.push_back({std::move(work), std::move(ended)});
  if (!std::exchange(shared_->runs, true)) start();
}

void WorkQueue::stop_present() {
  const std::lock_guard lock(shared_->mutex);
  shared_->present.request_stop();
}

bool WorkQueue::wait(std::chrono::milliseconds limit) {
  std::unique_lock lock(shared_->mutex);
  return shared_->idle.wait_for(lock, limit, [&] { return shared_->pieces.empty(); });
}

void WorkQueue::start() {
  const auto work = [shared = shared_](BackgroundJob&) {
    std::unique_lock lock(shared->mutex);
    while (!shared->pieces.empty()) {
      const Work& present = shared->pieces.front().work;
      shared->present = std::stop_source();
      const Progress progress{nullptr, shared->present.get_token()};
      lock.unlock();
      const Status done = without_exceptions([&] { return present(progress); });
      lock.lock();
      shared->receiver->send([ended = std::move(shared->pieces.front().ended), done] { ended(done); });
      shared->pieces.pop_front();
    }
    shared->runs = false;
    shared->idle.notify_all();
  };
  const auto cut_off = [shared = shared_](const Error& error) {
    const std::lock_guard lock(shared->mutex);
    shared->runs = false;
    for (Shared::Piece& piece : std::exchange(shared->pieces, {})) {
      shared->receiver->send(
          [ended = std::move(piece.ended), error] { ended(tl::unexpected<Error>(error)); });
    }
    shared->idle.notify_all();
  };
  BackgroundJob::start(QCoreApplication::instance(), work, cut_off);
}

}  // namespace tidemark::engine
