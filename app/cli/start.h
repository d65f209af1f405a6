// Where the level set starts: a mask, a threshold, a saved phi, seeds and erasers.
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/cli/arguments.h"
#include "app/cli/console.h"
#include "core/volume.h"
#include "solver/executor.h"

namespace tidemark::cli {

// At most one of the init options; seeds are added to it, then erasers are taken away.
struct StartOptions {
  std::vector<SphereArgument> seeds;
  std::vector<SphereArgument> erasers;
  std::optional<std::string> mask;               // --init
  std::optional<std::vector<double>> threshold;  // --init-threshold: low, high
  std::optional<std::vector<double>> flood;      // --init-flood: i, j, k, low, high
  std::optional<std::string> phi;                // --init-phi

  [[nodiscard]] bool given() const { return !seeds.empty() || mask || threshold || flood || phi; }
};

void add_start_options(CLI::App& app, StartOptions& options);

// What needs no volume: at most one init option, limits in order. Fails with ErrorKind::usage.
Status check(const StartOptions& options);

// What needs the volume's grid: every centre inside it. Fails with ErrorKind::usage.
Status check_inside(const StartOptions& options, const Geometry& geometry);

// Gives the executor its start. `source` is the volume as the solver sees it. Fails with ErrorKind::input
// when a file cannot be read or lies on another grid, with ErrorKind::usage when nothing is inside.
Status start(Executor& executor, const Volume& source, const StartOptions& options, Console& console);

// One line for people: "2 seeds, 1 eraser", "mask.nii.gz, 1 seed".
[[nodiscard]] std::string describe(const StartOptions& options);

}  // namespace tidemark::cli
