// The entries that a level set makes in the history: open ones, and those that are made whole or not at all.
#include <cmath>
#include <cstdlib>
#include <utility>

#include "document/level_set.h"
#include "document/level_set_change.h"

namespace tidemark::document {
namespace {

bool is_of_parameters(ChangeKind kind) {
  return kind == ChangeKind::target || kind == ChangeKind::range || kind == ChangeKind::smoothing ||
         kind == ChangeKind::parameters;
}

bool moves_phi(ChangeKind kind) {
  return !is_of_parameters(kind) && kind != ChangeKind::source && kind != ChangeKind::examples &&
         kind != ChangeKind::speed;
}

// Which of the parameters was changed.
ChangeKind kind_of_change(const solver::Parameters& before, const solver::Parameters& after) {
  solver::Parameters changed = before;
  changed.target = after.target;
  if (changed == after) return ChangeKind::target;
  changed = before;
  changed.range = after.range;
  if (changed == after) return ChangeKind::range;
  changed = before;
  changed.alpha = after.alpha;
  return changed == after ? ChangeKind::smoothing : ChangeKind::parameters;
}

}  // namespace

ChangeDescription LevelSet::description() const {
  ChangeKind kind = open_->kind;
  if (is_of_parameters(kind)) kind = kind_of_change(open_->before.recipe.final_parameters(), parameters());
  return {kind, kind == ChangeKind::evolution ? step() - open_->before.recipe.steps : 0, {}};
}

std::int64_t LevelSet::bytes() const {
  std::int64_t sum = open_->before.phi->pages.bytes();
  if (open_->last_edit) sum += open_->last_edit->phi->pages.bytes();
  return sum;
}

Status LevelSet::close() {
  Status known = read_back_phi();
  if (known && !open_->before.same_as(known_)) {
    // The change stays open, as far as it has no entry yet, if there is no memory for one.
    // A function that has arrived since the last edit makes none of its own.
    if (open_->last_edit && open_->last_edit->recipe.steps != known_.recipe.steps) {
      add_entry(description().kind, open_->before, *open_->last_edit);
      open_ = Open{ChangeKind::evolution, 0, *std::move(open_->last_edit), std::nullopt};
    }
    add_entry(description().kind, open_->before, known_);
  }
  open_.reset();
  return known;
}

// An entry from that point to the present one. Without memory for it the present point is that one, as it is
// for the history.
void LevelSet::enter(ChangeKind kind, Point before) {
  try {
    add_entry(kind, before, known_);
  } catch (...) {
    known_ = std::move(before);
    throw;
  }
}

void LevelSet::add_entry(ChangeKind kind, const Point& before, const Point& after) {
  std::int64_t steps = 0;
  if (kind == ChangeKind::sweep) steps = after.recipe.steps;
  if (kind == ChangeKind::evolution || kind == ChangeKind::step_back)
    steps = std::abs(after.recipe.steps - before.recipe.steps);
  history_.add({kind, steps, {}}, std::make_unique<LevelSetChange>(*this, before, after), steering_of(after));
  settled_events_ = after.recipe.events.size();
}

Status LevelSet::end_run() {
  return history_.close();
}

// Before an edit: ends what goes on unless the edit belongs to it.
Status LevelSet::end_other_change(std::uint64_t gesture) {
  if (open_ && gesture != 0 && open_->gesture == gesture) return {};
  return history_.close();
}

// Unless one goes on, an entry begins at `before`.
void LevelSet::begin_change(ChangeKind kind, std::uint64_t gesture, Point before) {
  if (open_) {
    open_->last_edit.reset();
    if (moves_phi(kind) && !moves_phi(open_->kind)) open_->kind = kind;
    return;
  }
  open_ = Open{kind, gesture, std::move(before), std::nullopt};
  history_.open(*this);
}

}  // namespace tidemark::document
