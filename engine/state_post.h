// The newest state of a case on its way from the engine's thread to the proxy's.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <utility>

#include "engine/case_state.h"
#include "engine/weak_receiver.h"

namespace tidemark::engine {

// The proxy may be busy: of several states only the newest one arrives.
class StatePost {
 public:
  using Arrived = std::function<void(CaseState)>;
  // `arrived` is called on the receiver's thread.
  StatePost(std::shared_ptr<WeakReceiver> receiver, Arrived arrived)
      : receiver_(std::move(receiver)), arrived_(std::move(arrived)) {}

  void send(CaseState state) {
    {
      const std::lock_guard lock(box_->mutex);
      box_->state = std::move(state);
      if (std::exchange(box_->announced, true)) return;
    }
    receiver_->send([arrived = arrived_, box = box_] {
      CaseState newest;
      {
        const std::lock_guard lock(box->mutex);
        box->announced = false;
        newest = std::move(box->state);
      }
      arrived(std::move(newest));
    });
  }

 private:
  struct Box {
    std::mutex mutex;
    CaseState state;
    bool announced = false;
  };

  std::shared_ptr<WeakReceiver> receiver_;
  Arrived arrived_;
  std::shared_ptr<Box> box_ = std::make_shared<Box>();
};

}  // namespace tidemark::engine
