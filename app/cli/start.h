// The start of a level set on the command line: a mask, a threshold, the speed, a saved phi, seeds and
// erasers.
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/cli/arguments.h"
#include "app/cli/console.h"
#include "app/cli/image_files.h"
#include "core/volume.h"
#include "document/start.h"

namespace tidemark::cli {

inline constexpr int kLevelsBySize = 0;

// At most one of the init options; seeds are added to it, then erasers are subtracted.
struct StartOptions {
  std::vector<SphereArgument> seeds;
  std::vector<SphereArgument> erasers;
  std::optional<std::string> mask;               // --init
  std::optional<std::vector<double>> threshold;  // --init-threshold: low, high
  std::optional<std::vector<double>> flood;      // --init-flood: i, j, k, low, high
  bool speed = false;                            // --init-speed
  std::optional<std::string> phi;                // --init-phi
  int levels = 1;                                // --levels; kLevelsBySize: auto

  [[nodiscard]] bool given() const { return !seeds.empty() || mask || threshold || flood || speed || phi; }
};

void add_start_options(CLI::App& app, StartOptions& options);

// --levels, of commands that begin coarse to fine.
void add_levels_option(CLI::App& app, StartOptions& options);

// The checks without a volume: at most one init option, limits in order, no levels of a saved phi. Fails with
// ErrorKind::usage.
Status check(const StartOptions& options);

// The check on the volume's grid: every centre lies inside it. Fails with ErrorKind::usage.
Status check_inside(const StartOptions& options, const Geometry& geometry);

// The start with its files read, on the grid of the study. `band` is that of the level set. Fails with
// ErrorKind::input when a file cannot be read or lies on another grid.
Result<document::Start> make_start(const StartOptions& options, const StudyPlace& study, double band,
                                   Console& console);

}  // namespace tidemark::cli
