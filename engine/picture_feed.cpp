#include "engine/picture_feed.h"

#include "engine/case_proxy.h"
#include "engine/case_runner.h"
#include "engine/view_slot.h"

namespace tidemark::engine {

PictureFeed::PictureFeed(CaseProxy& proxy, QObject* parent)
    : QObject(parent), runner_(proxy.runner()), slot_(std::make_shared<ViewSlot>()) {
  slot_->weak_receiver = WeakReceiver::of(this);
  slot_->take = [this] { take(); };
  runner_->add_view(slot_);
}

PictureFeed::~PictureFeed() {
  slot_->weak_receiver->close();
}

void PictureFeed::request(const AnyView& view, renderer::PictureSize size,
                          const std::shared_ptr<const document::Labels>& labels) {
  {
    const std::lock_guard lock(slot_->mutex);
    ViewSlot::Wish wish{view, size, labels};
    const bool is_new = slot_->wish != wish;
    if (std::exchange(slot_->seen, true) && !is_new) return;
    if (is_new) {
      slot_->wish = std::move(wish);
      slot_->wish_is_new = true;
    }
  }
  runner_->view_changed(slot_);
}

void PictureFeed::withdraw() {
  const std::lock_guard lock(slot_->mutex);
  slot_->seen = false;
}

void PictureFeed::take() {
  slot_->announced = false;
  {
    const std::lock_guard lock(slot_->mutex);
    shown_ = slot_->finished;
  }
  emit arrived();
}

}  // namespace tidemark::engine
