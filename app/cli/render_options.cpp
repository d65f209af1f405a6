#include "app/cli/render_options.h"

#include <fmt/ranges.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "app/cli/arguments.h"
#include "app/cli/renderer_option.h"

namespace tidemark::cli {
namespace {

constexpr std::int64_t kLargestPicture = 8192;

// A word of an option and its meaning.
template <class Value>
using Words = std::initializer_list<std::pair<const char*, Value>>;

const Words<renderer::Region> kRegions{{"off", renderer::Region::everywhere},
                                       {"inside", renderer::Region::inside},
                                       {"outside", renderer::Region::outside},
                                       {"tinted", renderer::Region::tinted}};
const Words<renderer::SpeedTerm> kTerms{{"data", renderer::SpeedTerm::data},
                                        {"curvature", renderer::SpeedTerm::curvature},
                                        {"rescaling", renderer::SpeedTerm::rescaling},
                                        {"total", renderer::SpeedTerm::total}};
const Words<renderer::SurfaceColouring> kColourings{
    {"plain", renderer::SurfaceColouring::plain},
    {"data", renderer::SurfaceColouring::data},
    {"curvature-term", renderer::SurfaceColouring::curvature_term},
    {"rescaling", renderer::SurfaceColouring::rescaling},
    {"total", renderer::SurfaceColouring::total_speed},
    {"curvature", renderer::SurfaceColouring::curvature},
    {"pages", renderer::SurfaceColouring::pages}};
const Words<int> kViews{{"3d", 0},    {"axial", 1}, {"coronal", 2}, {"sagittal", 3}, {"oblique", 4},
                        {"speed", 5}, {"doubt", 8}, {"pages", 6},   {"sheet", 7}};
const Words<renderer::Mode> kModes{{"raycast", renderer::Mode::raycast}, {"slices", renderer::Mode::slices}};
const Words<int> kClipped{{"both", 0}, {"source", 1}, {"surface", 2}};

template <class Value>
std::string joined(const Words<Value>& words, const char* between) {
  std::string all;
  for (const auto& [word, value] : words) all += (all.empty() ? "" : between) + std::string(word);
  return all;
}

template <class Value>
Result<Value> meaning(const char* option, const std::string& text, const Words<Value>& words) {
  for (const auto& [word, value] : words) {
    if (text == word) return value;
  }
  return fail(ErrorKind::usage, "{} '{}' is unknown; use {}", option, text, joined(words, ", "));
}
Result<renderer::PictureSize> parse_size(const std::string& text) {
  const std::size_t cross = text.find('x');
  if (cross != std::string::npos) {
    const auto width = parse_count(text.substr(0, cross));
    const auto height = parse_count(text.substr(cross + 1));
    if (width && height && *width >= 16 && *height >= 16 && *width <= kLargestPicture &&
        *height <= kLargestPicture) {
      return renderer::PictureSize{*width, *height};
    }
  }
  return fail(ErrorKind::usage, "--size {}: WIDTHxHEIGHT is needed, each from 16 to {} pixels", text,
              kLargestPicture);
}

Result<renderer::Camera> parse_camera(const std::string& text) {
  for (const std::size_t count : {2U, 3U}) {
    const auto numbers = parse_numbers(text, count);
    if (!numbers) continue;
    renderer::Camera camera;
    camera.azimuth = (*numbers)[0];
    camera.elevation = (*numbers)[1];
    if (count == 3) camera.zoom = (*numbers)[2];
    constexpr double kMostZoom = 1000.0;
    constexpr double kMostDegrees = 3600.0;
    if (camera.zoom >= 1.0 / kMostZoom && camera.zoom <= kMostZoom &&
        std::abs(camera.azimuth) <= kMostDegrees && std::abs(camera.elevation) <= kMostDegrees) {
      return camera;
    }
  }
  return fail(ErrorKind::usage, "--camera {}: AZIMUTH,ELEVATION[,ZOOM] is needed, in degrees", text);
}
Result<renderer::ClipPlane> clip_plane(const RenderOptions& options) {
  const std::vector<double>& c = *options.clip;
  const glm::dvec3 normal(c[0], c[1], c[2]);
  const double length = glm::length(normal);
  if (length <= 0.0) return fail(ErrorKind::usage, "--clip: the plane needs a normal");
  const auto clipped = meaning("--clipped", options.clipped, kClipped);
  if (!clipped) return pass_on(clipped);
  renderer::ClipPlane plane;
  plane.normal = normal / length;
  plane.offset_mm = c[3] / length;
  plane.clips_source = *clipped != 2;
  plane.clips_surface = *clipped != 1;
  return plane;
}

Result<renderer::TransferFunction> transfer_function(const RenderOptions& options) {
  auto function = options.preset.empty() ? renderer::TransferFunction::load(options.transfer_function)
                                         : renderer::preset(options.preset);
  if (function && function->source_needs_phi() && !has_surface(options)) {
    return fail(ErrorKind::usage, "'{}' looks at the surface: give --mask or --phi", function->name);
  }
  return function;
}

// The checks that need no volume.
Result<renderer::VolumeView> volume_view(const RenderOptions& options) {
  renderer::VolumeView view;
  const auto mode = meaning("--mode", options.mode, kModes);
  if (!mode) return pass_on(mode);
  view.mode = *mode;
  const auto camera = parse_camera(options.camera);
  if (!camera) return pass_on(camera);
  view.camera = *camera;
  if (!options.preset.empty() || !options.transfer_function.empty()) {
    auto function = transfer_function(options);
    if (!function) return pass_on(function);
    view.source = std::move(*function);
  }
  const auto region = meaning("--roi", options.region, kRegions);
  if (!region) return pass_on(region);
  view.region = *region;
  const auto colouring = meaning("--colour", options.colour, kColourings);
  if (!colouring) return pass_on(colouring);
  view.colouring = *colouring;
  view.surface = has_surface(options);
  if (options.opacity) view.surface_colour.a = static_cast<float>(*options.opacity);
  if (options.occlusion) view.lighting.occlusion = *options.occlusion;
  TIDEMARK_TRY(meaning("--clipped", options.clipped, kClipped));
  if (options.clip) {
    const auto plane = clip_plane(options);
    if (!plane) return pass_on(plane);
    view.clip = *plane;
  }
  return view;
}

Result<renderer::SliceView> slice_view(const RenderOptions& options) {
  renderer::SliceView view;
  if (options.view == "coronal") view.orientation = renderer::kCoronal;
  if (options.view == "sagittal") view.orientation = renderer::kSagittal;
  if (options.view == "oblique") {
    const std::vector<double>& n = *options.normal;
    if (glm::length(glm::dvec3(n[0], n[1], n[2])) <= 0.0) {
      return fail(ErrorKind::usage, "--normal: must not be 0");
    }
    view.orientation = renderer::oblique({n[0], n[1], n[2]});
  }
  if (options.view == "speed") view.content = renderer::SliceContent::speed;
  if (options.view == "pages") view.content = renderer::SliceContent::pages;
  const auto term = meaning("--term", options.term, kTerms);
  if (!term) return pass_on(term);
  view.term = *term;
  if (options.view == "doubt") {
    view.content = renderer::SliceContent::speed;
    view.term = renderer::SpeedTerm::doubt;
  }
  view.nearest = options.nearest;
  view.contours = options.contours;
  return view;
}
Status check(const RenderOptions& options) {
  TIDEMARK_TRY(meaning("--view", options.view, kViews));
  const int surfaces = int{!options.mask.empty()} + int{!options.phi.empty()} + int{!options.recipe.empty()};
  if (surfaces > 1) {
    return fail(ErrorKind::usage, "{} exclude each other",
                options.recipe.empty() ? "--mask and --phi" : "--recipe, --mask and --phi");
  }
  if (!options.preset.empty() && !options.transfer_function.empty()) {
    return fail(ErrorKind::usage, "--preset and --tf exclude each other");
  }
  for (const auto& [name, value] :
       {std::pair{"--opacity", options.opacity}, {"--occlusion", options.occlusion}}) {
    if (value && !(*value >= 0.0 && *value <= 1.0))
      return fail(ErrorKind::usage, "{} {}: must be 0 to 1", name, *value);
  }
  if (options.view == "oblique" && !options.normal)
    return fail(ErrorKind::usage, "--view oblique needs --normal");
  const bool by_speed =
      options.view == "speed" ||
      (options.colour != "plain" && options.colour != "curvature" && options.colour != "pages");
  if (by_speed && !has_speed(options))
    return fail(ErrorKind::usage, "a term of the speed needs --target and --range, or a --speed");
  if (options.window && !((*options.window)[1] > 0.0)) {
    return fail(ErrorKind::usage, "--window: the width must be above 0");
  }
  if (options.target.has_value() != options.range.has_value()) {
    return fail(ErrorKind::usage, "--target and --range belong together");
  }
  TIDEMARK_TRY(check(shown_drive(options), false));
  TIDEMARK_TRY(check_tent(options.drive, options.target.has_value(), options.range.has_value()));
  if (options.view == "doubt" && !options.drive.examples) {
    return fail(ErrorKind::usage, "--view doubt needs --speed examples");
  }
  const bool shows_speed = by_speed || options.view == "doubt" || options.view == "sheet";
  if (!options.drive.functions.empty() && !shows_speed) {
    return fail(ErrorKind::usage,
                "--speed is seen with --view speed, doubt or sheet, or a --colour of the speed");
  }
  if ((options.drive.walls || options.drive.anchors) && options.view == "3d") {
    return fail(ErrorKind::usage, "--walls and --anchors are seen on slices, not with --view 3d");
  }
  if ((options.region == "inside" || options.region == "outside") && !has_surface(options)) {
    return fail(ErrorKind::usage, "--roi {} needs --mask or --phi", options.region);
  }
  if (options.view == "3d" && !has_surface(options) && options.labels.empty() && options.preset.empty() &&
      options.transfer_function.empty()) {
    return fail(ErrorKind::usage, "nothing to show: give --mask, --phi, --labels, --preset or --tf");
  }
  return {};
}

}  // namespace

bool has_surface(const RenderOptions& options) {
  return !options.mask.empty() || !options.phi.empty() || !options.recipe.empty();
}

std::vector<std::string> inputs_of(const RenderOptions& options) {
  std::vector<std::string> inputs = inputs_of(options.drive);
  for (const std::string& input :
       {options.mask, options.phi, options.recipe, options.labels, options.transfer_function}) {
    if (!input.empty()) inputs.push_back(input);
  }
  return inputs;
}

bool has_speed(const RenderOptions& options) {
  return (options.target && options.range) || !options.drive.uses_tent();
}

DriveOptions shown_drive(const RenderOptions& options) {
  return options.recipe.empty() ? options.drive : options.drive.without_unused_files();
}

Result<Views> views_of(const RenderOptions& options) {
  TIDEMARK_TRY(check(options));
  const auto size = parse_size(options.size);
  if (!size) return pass_on(size);
  const auto volume = volume_view(options);
  if (!volume) return pass_on(volume);
  const auto slice = slice_view(options);
  if (!slice) return pass_on(slice);
  solver::Parameters parameters;
  if (options.target) parameters.target = *options.target;
  if (options.range) parameters.range = *options.range;
  if (options.alpha) parameters.alpha = *options.alpha;
  TIDEMARK_TRY(tidemark::solver::check(parameters));
  return Views{*size, *volume, *slice, parameters};
}

void add_render_options(CLI::App& command, RenderOptions& options) {
  add_study_input(command, options.study);
  command.add_option("--mask", options.mask, "Mask whose surface is shown");
  command.add_option("--phi", options.phi,
                     "Saved level set whose surface is shown: above 0 inside, in smallest voxels");
  command.add_option("--labels", options.labels, "Labels, shown in colours of their own");
  command.add_option("--view", options.view, "What is drawn (default: 3d)")->type_name(joined(kViews, "|"));
  command.add_option("--preset", options.preset,
                     "Volume rendering: " + fmt::format("{}", fmt::join(renderer::preset_names(), ", ")));
  command.add_option("--tf", options.transfer_function,
                     "Volume rendering: a transfer function of your own, as JSON");
  command.add_option("--roi", options.region, "Where the volume rendering shows: off is everywhere")
      ->type_name(joined(kRegions, "|"));
  command.add_option("--colour", options.colour, "What colours the surface (default: plain)")
      ->type_name(joined(kColourings, "|"));
  command.add_option("--opacity", options.opacity, "Of the surface, 0 to 1 (default: 1)");
  command.add_option("--occlusion", options.occlusion, "How much hollows of the surface darken, 0 to 1");
  add_numbers(command, "--clip", "NX,NY,NZ,D", options.clip, "Clip plane in the patient (LPS, mm)");
  command.add_option("--clipped", options.clipped, "What it cuts (default: both)")
      ->type_name(joined(kClipped, "|"));
  add_numbers(command, "--normal", "NX,NY,NZ", options.normal, "Across the oblique slice (LPS)");
  add_numbers(command, "--at", "I,J,K", options.at,
              "A voxel that the slice goes through (default: the middle of the surface, or of the volume)");
  add_numbers(command, "--window", "CENTRE,WIDTH", options.window,
              "Window in the source's units (default: the file's)");
  command.add_flag("--nearest", options.nearest, "Slices show voxels as they are, not interpolated");
  command.add_flag("--contours", options.contours, "Slices show where phi is -2, -1, 1 and 2");
  add_number(command, "--target", options.target, "T, for the speed");
  add_number(command, "--range", options.range, "epsilon, for the speed");
  add_number(command, "--alpha", options.alpha, "alpha, for the speed (default: 0.5)");
  command.add_option("--term", options.term, "What --view speed shows (default: data, which is D)")
      ->type_name(joined(kTerms, "|"));
  add_drive_options(command, options.drive);
  command.add_option("--camera", options.camera,
                     "AZIMUTH,ELEVATION[,ZOOM] in degrees: 0,0 looks from the front (default); azimuth goes\n"
                     "towards the patient's left, elevation towards the head");
  command
      .add_option("--mode", options.mode,
                  "How gl makes 3D pictures (default: raycast); host casts rays in either mode")
      ->type_name(joined(kModes, "|"));
  add_renderer_option(command, options.renderer);
  command.add_flag("--fit", options.fit, "The camera looks at the pages around the surface and comes near");
  command.add_flag("--annotate", options.annotate, "Orientation letters and a scale bar");
  command.add_option("--size", options.size, "Pixels (default: 512x512)")->type_name("WxH");
}

}  // namespace tidemark::cli
