#include "ui/views/gesture.h"

#include <utility>

namespace tidemark::ui {

bool Gesture::Ground::is_in_slice_of(const Ground& other) const {
  return slab && other.slab ? slab->is_same_as(*other.slab) : !slab && !other.slab;
}

bool Gesture::Ground::is_same_as(const Ground& other) const {
  return is_in_slice_of(other) && tool == other.tool && way == other.way;
}

void Gesture::begin(std::unique_ptr<Drag> drag, Qt::MouseButton button, Ground ground) {
  drag_ = std::move(drag);
  first_button_ = button_ = button;
  ground_ = ground;
  ended_by_click_ = false;
}

void Gesture::keep_to(const Ground& ground) {
  if (is_held() && drag_ && !ground_.is_in_slice_of(ground)) lift(true);
  if (waits_for_click() && !ground_.is_same_as(ground)) stop();
}

void Gesture::leave() {
  if (waits_for_click() && drag_->stays_behind()) stop();
}

void Gesture::press(const Pointer& pointer) {
  if (pointer.button != first_button_) return;
  button_ = first_button_;
  drag_->press(pointer);
}

void Gesture::lift(bool counts) {
  button_ = Qt::NoButton;
  if (!drag_ || drag_->lifted()) return;
  ended_by_click_ = drag_->is_of_clicks();
  end(counts);
}

// By its release the display may change, of which keep_to() hears.
void Gesture::end(bool counts) {
  const std::unique_ptr<Drag> ended = std::move(drag_);
  if (counts) ended->release();
}

bool Gesture::takes(int key) const {
  const bool gives_up = key == Qt::Key_Escape;
  const bool ends = key == Qt::Key_Return || key == Qt::Key_Enter;
  return waits_for_click() ? gives_up || ends : gives_up && drag_ && drag_->acts_at_its_end();
}

void Gesture::press_key(int key) {
  if (!takes(key)) return;
  end(key != Qt::Key_Escape);
}

}  // namespace tidemark::ui
