#include "document/session_drives.h"

#include <map>
#include <unordered_set>

namespace tidemark::document {
namespace {

// Each place of a drive; null: it has none. `Contents`: const or not.
template <class Contents, class Visit>
void for_each_place(Contents& contents, const Visit& visit) {
  const auto look_at = [&](auto& recipe, auto& wanted_drive) {
    visit(recipe.drive);
    for (auto& event : recipe.events) {
      if (auto* later = std::get_if<DriveEvent>(&event.what)) visit(later->drive);
    }
    visit(wanted_drive);
  };
  look_at(contents.recipe, contents.wanted_drive);
  for (auto& state : contents.history.states) look_at(state.recipe, state.wanted_drive);
}

}  // namespace

void visit_drives(const SessionContents& contents, const std::function<void(const Drive&)>& visit) {
  std::unordered_set<const Drive*> seen;
  for_each_place(contents, [&](const std::shared_ptr<const Drive>& drive) {
    if (drive != nullptr && seen.insert(drive.get()).second) visit(*drive);
  });
}

void change_drives(SessionContents& contents, const std::function<void(Drive&)>& change) {
  std::map<std::shared_ptr<const Drive>, std::shared_ptr<const Drive>> known;
  for_each_place(contents, [&](std::shared_ptr<const Drive>& drive) {
    if (drive == nullptr) return;
    auto& copy = known[drive];
    if (copy == nullptr) copy = changed_drive(drive, change);
    drive = copy;
  });
}

}  // namespace tidemark::document
