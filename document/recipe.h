// A recipe: everything done to a level set since its start, by step number. It replays to the same voxels.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "document/drive.h"
#include "document/start.h"
#include "imaging/grid_policy.h"
#include "solver/parameters.h"

namespace tidemark::document {

struct PaintEvent {
  solver::Sphere sphere;
  solver::Brush brush = solver::Brush::add;
  bool operator==(const PaintEvent&) const = default;
};
struct ParametersEvent {
  solver::Parameters parameters;
  bool operator==(const ParametersEvent&) const = default;
};
// From here on the level set sees the volume smoothed by that much; 0: not at all.
struct SmoothEvent {
  double sigma_mm = 0.0;
  bool operator==(const SmoothEvent&) const = default;
};
// From here on that drives the level set; never null.
struct DriveEvent {
  std::shared_ptr<const Drive> drive;
  bool operator==(const DriveEvent&) const = default;
};
// phi was put back (undo, recovery). Executors then forget which pages are quiet, which changes the last bits
// of the steps that follow.
struct ResumeEvent {
  bool operator==(const ResumeEvent&) const = default;
};

// The executor: the same bits come from the same one with the same pages.
struct RecipeExecutor {
  std::string name;  // as Executor::name()
  Index3 page_shape = kDefaultPageShape;
  bool skip_quiet_pages = true;
  bool operator==(const RecipeExecutor&) const = default;
};
// From here on that one computes; phi was put into it.
struct ExecutorEvent {
  RecipeExecutor executor;
  bool operator==(const ExecutorEvent&) const = default;
};

// Happens when that many steps have been computed.
struct RecipeEvent {
  std::int64_t step = 0;
  std::variant<PaintEvent, ParametersEvent, SmoothEvent, DriveEvent, ResumeEvent, ExecutorEvent> what;
  bool operator==(const RecipeEvent&) const = default;
};

// The volume's facts, so that another one is noticed.
struct RecipeSource {
  Index3 size{0};
  glm::dvec3 spacing_mm{1.0};
  std::string series_uid;
  std::string checksum;        // see checksum.h; empty: unknown
  imaging::GridPolicy policy;  // by which the slices of the series were made a grid
  bool operator==(const RecipeSource&) const = default;
};

struct Recipe {
  // Each recipe is written with the first version that can read it: where a tent drives the surface and
  // nothing holds it, where another drive does, where the start is computed coarse to fine, and where
  // another executor goes on.
  static constexpr int kVersionOfTents = 1;
  static constexpr int kVersionOfDrives = 2;
  static constexpr int kVersionOfLevels = 3;
  static constexpr int kVersion = 4;
  static constexpr std::size_t kLargestFile = std::size_t{64} << 20;  // bytes

  RecipeSource source;
  RecipeExecutor executor;   // at the start
  double smoothed_mm = 0.0;  // at the start
  Start start;
  solver::Parameters parameters;       // at the start
  std::shared_ptr<const Drive> drive;  // at the start; null: the tent, and nothing that holds the surface
  std::vector<RecipeEvent> events;
  std::int64_t steps = 0;  // in all

  // JSON. Fails (ErrorKind::usage) when the start is too large for a file.
  [[nodiscard]] Result<std::string> to_text() const;
  // Fails (ErrorKind::input) naming `file` and the field: not JSON, an unknown version, something that is
  // missing or not within its limits.
  static Result<Recipe> parse(std::string_view text, const std::string& file);
  static Result<Recipe> load(const std::filesystem::path& file);

  [[nodiscard]] bool begun() const;  // there is a surface
  [[nodiscard]] const solver::Parameters& final_parameters() const;
  [[nodiscard]] double final_smoothed_mm() const;
  [[nodiscard]] const std::shared_ptr<const Drive>& final_drive() const;  // null: as `drive`
  [[nodiscard]] bool has_drive() const;                                   // at the start, or in an event
  [[nodiscard]] const RecipeExecutor& final_executor() const;
  // All of it is computed by that one.
  void set_executor(const RecipeExecutor& only);
  // The conditions of the first step become these. A start that was computed by a speed, coarse to fine or
  // where it is above 0, keeps those that it was computed with: others follow it as events.
  void set_conditions(const solver::Parameters& wanted, const std::shared_ptr<const Drive>& wanted_drive);
  // Of each drive a changed copy, at the start and in events.
  void change_drives(const std::function<void(Drive&)>& change);
  // The recipe up to that many steps, with the edits after the last of them.
  [[nodiscard]] Recipe up_to(std::int64_t step) const;
};

// The drive after that change; the same one where nothing of it differs.
[[nodiscard]] std::shared_ptr<const Drive> changed_drive(const std::shared_ptr<const Drive>& drive,
                                                         const std::function<void(Drive&)>& change);

}  // namespace tidemark::document
