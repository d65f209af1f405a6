// An entry of the history that takes a level set from one point to another and back.
#pragma once

#include <memory>

#include "document/level_set.h"

namespace tidemark::document {

class LevelSetChange : public Change {
 public:
  LevelSetChange(LevelSet& level_set, const LevelSet::Point& before, const LevelSet::Point& after);

  Status undo() override { return pass(before_); }
  Status redo() override { return pass(after_); }
  Status arrive() override { return level_set_.arrive(); }
  [[nodiscard]] std::int64_t bytes() const override;
  // What led to the state before the change, from what led to the one after it, and the other way round.
  [[nodiscard]] Recipe recipe_before(const Recipe& after) const { return with_common_events(before_, after); }
  [[nodiscard]] Recipe recipe_after(const Recipe& before) const { return with_common_events(after_, before); }
  [[nodiscard]] const Curve& curve_before() const { return before_.curve; }
  [[nodiscard]] const Curve& curve_after() const { return after_.curve; }
  [[nodiscard]] const std::shared_ptr<const Drive>& drive_before() const { return before_.drive; }
  [[nodiscard]] const std::shared_ptr<const Drive>& drive_after() const { return after_.drive; }

 private:
  // The part of a recipe beyond the events that both have.
  struct Side {
    Recipe recipe;  // its events: those that are not common
    std::shared_ptr<const solver::Field> phi;
    std::shared_ptr<const solver::Field> start;
    Curve curve;
    std::shared_ptr<const Drive> drive;
    std::size_t settled_events = 0;  // see LevelSet
  };
  Status pass(const Side& side);
  [[nodiscard]] Recipe with_common_events(const Side& side, const Recipe& other) const;

  LevelSet& level_set_;
  std::int64_t phi_bytes_ = 0;  // of what the two sides do not share
  std::size_t common_events_ = 0;
  Side before_;
  Side after_;
};

}  // namespace tidemark::document
