// The options of `tidemark-cli render`.
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/cli/drive_options.h"
#include "app/cli/study_input.h"
#include "renderer/picture.h"
#include "renderer/renderer.h"
#include "renderer/views.h"
#include "solver/parameters.h"

namespace tidemark::cli {

struct RenderOptions {
  StudyInput study;
  std::string mask;
  std::string phi;
  std::string recipe;  // of a film: its surface is shown
  std::string labels;
  std::string view = "3d";
  std::string preset;
  std::string transfer_function;
  std::string region = "off";
  std::string size = "512x512";
  std::optional<std::vector<double>> clip;
  std::string clipped = "both";
  std::optional<std::vector<double>> normal;
  std::optional<std::vector<double>> at;
  std::string camera = "0,0";
  std::string mode = "raycast";
  renderer::RendererKind renderer = renderer::RendererKind::automatic;
  std::optional<std::vector<double>> window;
  std::optional<double> target;
  std::optional<double> range;
  std::optional<double> alpha;
  DriveOptions drive;
  std::string term = "data";
  std::string colour = "plain";
  std::optional<double> opacity;
  std::optional<double> occlusion;
  bool fit = false;
  bool nearest = false;
  bool contours = false;
  bool annotate = false;
  std::string out;
};

// The views of the options, but for the facts that only the study knows: its middle, and its common
// values.
struct Views {
  renderer::PictureSize size;
  renderer::VolumeView volume;
  renderer::SliceView slice;
  solver::Parameters parameters;
};

bool has_surface(const RenderOptions& options);
bool has_speed(const RenderOptions& options);
// What drives the surface in the views. A recipe has a drive of its own, which --image and --speed-image may
// be for alone.
[[nodiscard]] DriveOptions shown_drive(const RenderOptions& options);

// Checks all options, also those that the chosen view does not use. Fails (ErrorKind::usage, or
// ErrorKind::input for an error in a file of a transfer function).
Result<Views> views_of(const RenderOptions& options);

// The files and folders that are read beside the study.
[[nodiscard]] std::vector<std::string> inputs_of(const RenderOptions& options);

// Without --out.
void add_render_options(CLI::App& command, RenderOptions& options);

}  // namespace tidemark::cli
