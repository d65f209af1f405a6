#include "document/level_set_change.h"

#include <algorithm>
#include <utility>

namespace tidemark::document {
namespace {

Recipe without_events(const Recipe& recipe, std::size_t common) {
  Recipe rest = recipe;
  rest.events.assign(recipe.events.begin() + static_cast<std::ptrdiff_t>(common), recipe.events.end());
  return rest;
}

// Bytes of what two fields do not share.
std::int64_t bytes_apart(const solver::Field& a, const solver::Field& b) {
  if (!(a.layout == b.layout)) return a.pages.bytes() + b.pages.bytes();
  std::int64_t pages = 0;
  SharedPages::for_each_difference(a.pages, b.pages, [&](std::int64_t page) {
    pages += (a.pages.is_stored(page) ? 1 : 0) + (b.pages.is_stored(page) ? 1 : 0);
  });
  return pages * a.layout.voxels_per_page() * static_cast<std::int64_t>(sizeof(float));
}

std::int64_t start_bytes(const Start& start) {
  std::int64_t bytes = 0;
  if (const auto* mask = std::get_if<MaskStart>(&start.from)) {
    bytes = static_cast<std::int64_t>(mask->mask->bits().size());
  } else if (const auto* phi = std::get_if<FieldStart>(&start.from)) {
    bytes = phi->phi->pages.bytes();
  }
  return bytes +
         static_cast<std::int64_t>((start.seeds.size() + start.erasers.size()) * sizeof(solver::Sphere));
}

}  // namespace

LevelSetChange::LevelSetChange(LevelSet& level_set, const LevelSet::Point& before,
                               const LevelSet::Point& after)
    : level_set_(level_set), phi_bytes_(bytes_apart(*before.phi, *after.phi)) {
  const auto& a = before.recipe.events;
  const auto& b = after.recipe.events;
  const auto [first_different, ignored] = std::mismatch(a.begin(), a.end(), b.begin(), b.end());
  common_events_ = std::min(static_cast<std::size_t>(first_different - a.begin()), level_set.settled_events_);
  before_ = {without_events(before.recipe, common_events_),
             before.phi,
             before.start,
             before.curve,
             before.drive,
             level_set.settled_events_};
  after_ = {without_events(after.recipe, common_events_),
            after.phi,
            after.start,
            after.curve,
            after.drive,
            after.recipe.events.size()};
}

std::int64_t LevelSetChange::bytes() const {
  const std::size_t events = before_.recipe.events.size() + after_.recipe.events.size();
  const std::size_t points = before_.curve.points()->size() + after_.curve.points()->size();
  std::int64_t sum =
      static_cast<std::int64_t>(sizeof(*this) + events * sizeof(RecipeEvent) + points * sizeof(CurvePoint)) +
      phi_bytes_;
  if (before_.drive != after_.drive) sum += bytes_of(*before_.drive) + bytes_of(*after_.drive);
  if (before_.start != after_.start) {
    // Entries of one start share it; it counts where it was made, and where it is left.
    for (const Side* side : {&before_, &after_}) {
      sum += start_bytes(side->recipe.start);
      if (side->start != nullptr) sum += side->start->pages.bytes();
    }
  }
  return sum;
}

Recipe LevelSetChange::with_common_events(const Side& side, const Recipe& other) const {
  Recipe recipe = side.recipe;
  recipe.events.insert(recipe.events.begin(), other.events.begin(),
                       other.events.begin() + static_cast<std::ptrdiff_t>(common_events_));
  return recipe;
}

Status LevelSetChange::pass(const Side& side) {
  level_set_.pass(
      {with_common_events(side, level_set_.recipe_), side.phi, side.start, side.curve, side.drive});
  level_set_.settled_events_ = side.settled_events;
  return {};
}

}  // namespace tidemark::document
