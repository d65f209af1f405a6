#include "session/picture_feed.h"

#include "session/case_runner.h"
#include "session/case_session.h"
#include "session/view_slot.h"

namespace tidemark {

PictureFeed::PictureFeed(CaseSession& session, QObject* parent)
    : QObject(parent), runner_(session.runner()), slot_(std::make_shared<ViewSlot>()) {
  slot_->outlet = Outlet::of(this);
  slot_->take = [this] { take(); };
  runner_->add_view(slot_);
}

PictureFeed::~PictureFeed() {
  slot_->outlet->close();
}

void PictureFeed::request(const AnyView& view, PictureSize size) {
  {
    const std::lock_guard lock(slot_->mutex);
    ViewSlot::Wish wish{view, size};
    if (slot_->wish == wish) return;
    slot_->wish = std::move(wish);
    slot_->wish_is_new = true;
  }
  runner_->view_changed(slot_);
}

void PictureFeed::take() {
  slot_->announced = false;
  {
    const std::lock_guard lock(slot_->mutex);
    shown_ = slot_->finished;
  }
  emit arrived();
}

}  // namespace tidemark
