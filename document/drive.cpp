#include "document/drive.h"

#include <algorithm>

#include "solver/speed/speed_registry.h"

namespace tidemark::document {

bool is_plain(const Drive& drive) {
  return drive.setting.is_tent() && (drive.constraints == nullptr || drive.constraints->empty());
}

bool uses_tent(const Drive& drive) {
  const auto& terms = drive.setting.terms;
  return std::any_of(terms.begin(), terms.end(), [](const auto& term) { return term.function == "tent"; });
}

std::string describe(const Drive& drive) {
  std::string text;
  for (const solver::SpeedTerm& term : drive.setting.terms)
    text += (text.empty() ? "" : " and ") + term.function;
  if (drive.setting.terms.size() > 1) {
    text = (drive.setting.combine == solver::Combine::least ? "the least of " : "the product of ") + text;
  }
  if (drive.constraints == nullptr) return text;
  if (drive.constraints->count(solver::Constraint::wall) > 0) text += ", walls";
  if (drive.constraints->count(solver::Constraint::anchor) > 0) text += ", anchors";
  return text;
}

Result<std::shared_ptr<const solver::SpeedFunction>> make_speed(const Drive& drive,
                                                                std::shared_ptr<const Volume> source,
                                                                const solver::Parameters& parameters,
                                                                const Progress& progress) {
  solver::SpeedInputs inputs;
  inputs.source = std::move(source);
  inputs.parameters = parameters;
  inputs.strokes = drive.strokes;
  if (drive.map != nullptr) {
    if (drive.map->volume == nullptr)
      return fail(ErrorKind::usage, "the map \"{}\" is missing", drive.map->name);
    inputs.map = drive.map->volume;
  }
  for (const auto& image : drive.images) {
    if (image->resampled == nullptr)
      return fail(ErrorKind::usage, "the image \"{}\" is missing", image->name);
    inputs.images.push_back(image->resampled);
  }
  return solver::make_speed(drive.setting, inputs, progress);
}

}  // namespace tidemark::document
