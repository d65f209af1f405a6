// How the engine's thread reaches an object of the user interface that may be gone by then.
#pragma once

#include <QMetaObject>
#include <QObject>
#include <functional>
#include <memory>
#include <mutex>
#include <utility>

namespace tidemark {

// Made with the object on its thread; the object closes it when it dies. Other threads keep it alive.
class Outlet {
 public:
  explicit Outlet(QObject* receiver) : receiver_(receiver) {}

  void close() {
    const std::lock_guard lock(mutex_);
    receiver_ = nullptr;
  }

  // Has `call` made on the receiver's thread, unless the receiver is gone.
  void send(std::function<void()> call) {
    const std::lock_guard lock(mutex_);
    if (receiver_) QMetaObject::invokeMethod(receiver_, std::move(call), Qt::QueuedConnection);
  }

 private:
  std::mutex mutex_;
  QObject* receiver_;
};

}  // namespace tidemark
