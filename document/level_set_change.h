// An entry of the history that takes a level set from one point to another and back.
#pragma once

#include <memory>
#include <vector>

#include "document/field_delta.h"
#include "document/level_set.h"

namespace tidemark::document {

class LevelSetChange : public Change {
 public:
  LevelSetChange(LevelSet& level_set, const LevelSet::Point& before, const LevelSet::Point& after);

  Status undo() override { return go(before_, delta_.before(*level_set_.known_.phi)); }
  Status redo() override { return go(after_, delta_.after(*level_set_.known_.phi)); }
  [[nodiscard]] std::int64_t bytes() const override;

 private:
  // The part of a recipe beyond the events that both have.
  struct Side {
    Recipe recipe;  // its events: those that are not common
    std::shared_ptr<const solver::Field> start;
    Curve curve;
    std::shared_ptr<const Drive> drive;
  };
  Status go(const Side& side, solver::Field phi);

  LevelSet& level_set_;
  FieldDelta delta_;
  std::size_t common_events_ = 0;
  Side before_;
  Side after_;
};

}  // namespace tidemark::document
