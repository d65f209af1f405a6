// The way by which other threads reach an object of the user interface that may be gone by then.
#pragma once

#include <QMetaObject>
#include <QObject>
#include <functional>
#include <memory>
#include <mutex>
#include <utility>

namespace tidemark::engine {

// Made with the object on its thread; other threads keep it alive.
class WeakReceiver : public std::enable_shared_from_this<WeakReceiver> {
 public:
  static std::shared_ptr<WeakReceiver> of(QObject* receiver) {
    return std::shared_ptr<WeakReceiver>(new WeakReceiver(receiver));
  }

  // On the receiver's thread, at the latest in its destructor: no call is made any more.
  void close() {
    const std::lock_guard lock(mutex_);
    receiver_ = nullptr;
  }

  // Any thread: has `call` made on the receiver's, unless it is closed by then.
  void send(std::function<void()> call) {
    const std::lock_guard lock(mutex_);
    if (receiver_ == nullptr) return;
    // Only the receiver's thread closes, so that a look without the lock is enough there.
    QMetaObject::invokeMethod(
        receiver_,
        [weak_receiver = shared_from_this(), call = std::move(call)] {
          if (weak_receiver->receiver_ != nullptr) call();
        },
        Qt::QueuedConnection);
  }

 private:
  explicit WeakReceiver(QObject* receiver) : receiver_(receiver) {}

  std::mutex mutex_;  // guards receiver_: it must not go while an event is posted to it
  QObject* receiver_;
};

}  // namespace tidemark::engine
