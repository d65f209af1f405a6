#include "document/drive.h"

#include <algorithm>

#include "solver/speed/speed_registry.h"

namespace tidemark::document {
namespace {

// By value: what was read from a file twice is in two places.
bool same_strokes(const std::shared_ptr<const solver::Strokes>& a,
                  const std::shared_ptr<const solver::Strokes>& b) {
  return a == b || (a != nullptr && b != nullptr && *a == *b);
}

bool same_image(const std::shared_ptr<const CaseImage>& a, const std::shared_ptr<const CaseImage>& b) {
  if (a == b) return true;
  return !a->checksum.empty() && a->checksum == b->checksum && a->to_case == b->to_case &&
         (a->volume == nullptr) == (b->volume == nullptr);
}

bool same_map(const std::shared_ptr<const SpeedMap>& a, const std::shared_ptr<const SpeedMap>& b) {
  if (a == b) return true;
  return a != nullptr && b != nullptr && !a->checksum.empty() && a->checksum == b->checksum &&
         (a->volume == nullptr) == (b->volume == nullptr);
}

}  // namespace

std::shared_ptr<const Drive> shared(const Drive& drive) {
  return drive == Drive() ? nullptr : std::make_shared<const Drive>(drive);
}

bool same_speed(const Drive& a, const Drive& b) {
  return a.setting == b.setting && same_strokes(a.strokes, b.strokes) && same_map(a.map, b.map) &&
         std::equal(a.images.begin(), a.images.end(), b.images.begin(), b.images.end(), same_image);
}

bool cover(const Drive& drive, const Drive& earlier) {
  if (earlier.constraints == nullptr || earlier.constraints->empty()) return true;
  if (drive.constraints == nullptr) return false;
  bool covered = true;
  const auto look_at = [&](std::int64_t page) {
    const solver::Constraint* const before = earlier.constraints->page(page);
    const solver::Constraint* const now = drive.constraints->page(page);
    if (before == nullptr) return;
    covered = covered && now != nullptr &&
              std::equal(before, before + solver::Constraints::kPageVoxels, now,
                         [](auto a, auto b) { return a == solver::Constraint::none || a == b; });
  };
  solver::Constraints::Pages::for_each_difference(earlier.constraints->pages(), drive.constraints->pages(),
                                                  look_at);
  return covered;
}

std::int64_t bytes_of(const Drive& drive) {
  std::size_t bytes = 0;
  if (drive.strokes)
    bytes += (drive.strokes->inside.size() + drive.strokes->outside.size()) * sizeof(std::int64_t);
  // Most pages are shared with the constraints before: this is the most that it can be.
  if (drive.constraints) bytes += static_cast<std::size_t>(drive.constraints->pages().bytes());
  return static_cast<std::int64_t>(bytes);
}

bool is_plain(const Drive& drive) {
  return drive.setting.is_tent() && (drive.constraints == nullptr || drive.constraints->empty());
}

bool uses_tent(const Drive& drive) {
  const auto& terms = drive.setting.terms;
  return std::any_of(terms.begin(), terms.end(), [](const auto& term) { return term.function == "tent"; });
}

bool uses_images(const solver::SpeedSetting& setting) {
  return solver::any_has(setting, &solver::SpeedKind::uses_images);
}

DriveSummary summary_of(const Drive& drive) {
  DriveSummary summary;
  summary.setting = drive.setting;
  if (drive.constraints != nullptr) {
    summary.has_walls = drive.constraints->count(solver::Constraint::wall) > 0;
    summary.has_anchors = drive.constraints->count(solver::Constraint::anchor) > 0;
  }
  return summary;
}

std::string describe(const Drive& drive) {
  std::string text;
  for (const solver::SpeedTerm& term : drive.setting.terms)
    text += (text.empty() ? "" : " and ") + term.function;
  if (drive.setting.terms.size() > 1) {
    text = (drive.setting.combine == solver::Combine::least ? "the least of " : "the product of ") + text;
  }
  const DriveSummary summary = summary_of(drive);
  if (summary.has_walls) text += ", walls";
  if (summary.has_anchors) text += ", anchors";
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
  if (drive.map != nullptr && solver::any_has(drive.setting, &solver::SpeedKind::needs_map)) {
    if (drive.map->volume == nullptr)
      return fail(ErrorKind::usage, "the map \"{}\" is missing", drive.map->name);
    inputs.map = drive.map->volume;
  }
  if (uses_images(drive.setting)) {
    for (const auto& image : drive.images) {
      auto voxels = on_grid(*image, inputs.source->geometry);
      if (!voxels) return pass_on(voxels);
      inputs.images.push_back(std::move(*voxels));
    }
  }
  return solver::make_speed(drive.setting, inputs, progress);
}

}  // namespace tidemark::document
