#include "document/recipe.h"

#include <algorithm>
#include <iterator>

#include "core/text_file.h"

namespace tidemark::document {
namespace {

template <class Event>
const Event* last_event(const std::vector<RecipeEvent>& events) {
  const auto found = std::find_if(events.rbegin(), events.rend(), [](const RecipeEvent& event) {
    return std::holds_alternative<Event>(event.what);
  });
  return found == events.rend() ? nullptr : &std::get<Event>(found->what);
}

}  // namespace

Result<Recipe> Recipe::load(const std::filesystem::path& file) {
  const auto text = read_text_file(file, kLargestFile);
  if (!text) return pass_on(text);
  return parse(*text, file.string());
}

bool Recipe::begun() const {
  return !start.empty() || std::any_of(events.begin(), events.end(), [](const RecipeEvent& event) {
    const auto* paint = std::get_if<PaintEvent>(&event.what);
    return paint != nullptr && paint->brush == solver::Brush::add;
  });
}

const solver::Parameters& Recipe::final_parameters() const {
  const auto* event = last_event<ParametersEvent>(events);
  return event != nullptr ? event->parameters : parameters;
}

double Recipe::final_smoothed_mm() const {
  const auto* event = last_event<SmoothEvent>(events);
  return event != nullptr ? event->sigma_mm : smoothed_mm;
}

const std::shared_ptr<const Drive>& Recipe::final_drive() const {
  const auto* event = last_event<DriveEvent>(events);
  return event != nullptr ? event->drive : drive;
}

bool Recipe::has_drive() const {
  return drive != nullptr || last_event<DriveEvent>(events) != nullptr;
}

const RecipeExecutor& Recipe::final_executor() const {
  const auto* event = last_event<ExecutorEvent>(events);
  return event != nullptr ? event->executor : executor;
}

void Recipe::set_executor(const RecipeExecutor& only) {
  executor = only;
  for (RecipeEvent& event : events) {
    if (std::holds_alternative<ExecutorEvent>(event.what)) event.what = ResumeEvent{};
  }
}

void Recipe::set_conditions(const solver::Parameters& wanted,
                            const std::shared_ptr<const Drive>& wanted_drive) {
  if (!start.needs_speed()) {
    parameters = wanted;
    drive = wanted_drive;
    return;
  }
  std::erase_if(events, [](const RecipeEvent& event) {
    return std::holds_alternative<ParametersEvent>(event.what) ||
           std::holds_alternative<DriveEvent>(event.what);
  });
  if (wanted != parameters) events.push_back({0, ParametersEvent{wanted}});
  if (value_of(wanted_drive) != value_of(drive)) {
    events.push_back({0, DriveEvent{std::make_shared<const Drive>(value_of(wanted_drive))}});
  }
}

void Recipe::change_drives(const std::function<void(Drive&)>& change) {
  const auto change_one = [&](std::shared_ptr<const Drive>& one) {
    if (one != nullptr) one = changed_drive(one, change);
  };
  change_one(drive);
  for (RecipeEvent& event : events) {
    if (auto* later = std::get_if<DriveEvent>(&event.what)) change_one(later->drive);
  }
}

std::shared_ptr<const Drive> changed_drive(const std::shared_ptr<const Drive>& drive,
                                           const std::function<void(Drive&)>& change) {
  Drive copy = *drive;
  change(copy);
  return copy == *drive ? drive : std::make_shared<const Drive>(std::move(copy));
}

Recipe Recipe::up_to(std::int64_t step) const {
  Recipe earlier = *this;
  std::erase_if(earlier.events, [&](const RecipeEvent& event) { return event.step > step; });
  earlier.steps = step;
  return earlier;
}

}  // namespace tidemark::document
