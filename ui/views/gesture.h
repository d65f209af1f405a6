// The drag that the mouse of a view is in: until its button is released, or from click to click.
#pragma once

#include <memory>
#include <optional>

#include "ui/views/drag.h"

namespace tidemark::ui {

class Gesture {
 public:
  // Where and with what it began. A gesture of clicks goes on there alone.
  struct Ground {
    engine::Tool tool{};
    engine::LabelWay way{};
    std::optional<engine::SliceSlab> slab;
    [[nodiscard]] bool is_in_slice_of(const Ground& other) const;
    [[nodiscard]] bool is_same_as(const Ground& other) const;
  };

  // With a button that is down from now on. Null: the button does nothing here.
  void begin(std::unique_ptr<Drag> drag, Qt::MouseButton button, Ground ground);
  // The button is still down and does something else from now on.
  void replace(std::unique_ptr<Drag> drag) { drag_ = std::move(drag); }
  void stop() { drag_.reset(); }
  // One that is held ends with its slice. One of clicks that began elsewhere is given up.
  void keep_to(const Ground& ground);
  // The mouse has left the view: one of clicks that stays behind is given up.
  void leave();
  // A further click; another button than the first has none.
  void press(const Pointer& pointer);
  // The button is up. `counts`: the drag has its effect.
  void lift(bool counts);
  // Return ends a gesture of clicks. Escape gives up that, and a drag that acts at its end.
  void press_key(int key);
  [[nodiscard]] Drag* drag() const { return drag_.get(); }
  [[nodiscard]] Qt::MouseButton button() const { return button_; }  // that is held down
  [[nodiscard]] bool is_held() const { return button_ != Qt::NoButton; }
  [[nodiscard]] bool waits_for_click() const { return drag_ && !is_held(); }
  // Whether the wheel and keys leave its slice alone.
  [[nodiscard]] bool holds_slice() const { return drag_ && (is_held() || !drag_->stays_behind()); }
  // Whether keys are its own now.
  [[nodiscard]] bool takes(int key) const;
  // Whether the last one was of clicks. The second click of a double click asks once.
  [[nodiscard]] bool take_ended_by_click() { return std::exchange(ended_by_click_, false); }

 private:
  void end(bool counts);

  std::unique_ptr<Drag> drag_;
  Qt::MouseButton button_ = Qt::NoButton;
  Qt::MouseButton first_button_ = Qt::NoButton;  // of the drag
  Ground ground_;
  bool ended_by_click_ = false;
};

}  // namespace tidemark::ui
