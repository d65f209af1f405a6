// A call that comes once a command is over, however that ended.
#pragma once

#include <functional>
#include <memory>
#include <utility>

#include "engine/weak_receiver.h"

namespace tidemark::engine {

// Held by the command.
class LastCall {
 public:
  LastCall(std::shared_ptr<WeakReceiver> receiver, std::function<void()> call)
      : receiver_(std::move(receiver)), call_(std::move(call)) {}
  ~LastCall() {
    if (call_) receiver_->send(std::move(call_));
  }
  LastCall(const LastCall&) = delete;
  LastCall& operator=(const LastCall&) = delete;
  void forget() { call_ = nullptr; }

 private:
  std::shared_ptr<WeakReceiver> receiver_;
  std::function<void()> call_;
};

}  // namespace tidemark::engine
