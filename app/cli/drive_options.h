// The options for what drives the surface: speed functions with their inputs, walls and anchors.
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/cli/console.h"
#include "app/cli/image_files.h"
#include "document/drive.h"
#include "document/start.h"

namespace tidemark::cli {

struct DriveOptions {
  std::vector<std::string> functions;  // --speed; none: the tent
  std::optional<solver::Combine> combine;
  std::vector<std::string> values;      // --speed-value FUNCTION.NAME=NUMBER
  std::vector<std::string> images;      // --image
  std::optional<std::string> examples;  // a label file: 1 inside, 2 outside
  std::optional<std::string> map;       // --speed-image
  std::optional<std::string> walls, anchors;
  std::optional<double> within_mm;

  [[nodiscard]] bool uses_tent() const;
  // Less the images and the map that none of its functions takes.
  [[nodiscard]] DriveOptions without_unused_files() const;
};

void add_drive_options(CLI::App& app, DriveOptions& options);
// --within, for commands that start from a mask.
void add_within_option(CLI::App& app, DriveOptions& options);
// --image and --speed-image alone: what a recipe needs beside its volume.
void add_image_options(CLI::App& app, DriveOptions& options);

// All checks that need no file. Fails (ErrorKind::usage) naming the option.
Status check(const DriveOptions& options, bool starts_from_mask);
// T and epsilon are the tent's. Fails (ErrorKind::usage) naming the option where there is no tent.
Status check_tent(const DriveOptions& options, bool has_target, bool has_range);
// The files and folders that are read.
[[nodiscard]] std::vector<std::string> inputs_of(const DriveOptions& options);

// The drive with its files read; null: nothing but the tent. Fails (ErrorKind::input, ErrorKind::usage)
// naming the file.
Result<std::shared_ptr<const document::Drive>> make_drive(const DriveOptions& options,
                                                          const StudyPlace& study, Console& console);

}  // namespace tidemark::cli
