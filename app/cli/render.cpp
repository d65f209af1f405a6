// tidemark-cli render: a picture of a study and its surface.
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

#include "app/cli/align.h"
#include "app/cli/arguments.h"
#include "app/cli/outputs.h"
#include "app/cli/program.h"
#include "gpu/device.h"
#include "imaging/files/png_file.h"
#include "imaging/study.h"
#include "renderer/sheet.h"
#include "solver/distance_transform.h"
#include "solver/model.h"

namespace tidemark::cli {
namespace {

constexpr const char* kSummary = "Draws a picture of a study and its surface";
constexpr const char* kDescription =
    "Draws INPUT, with the surface of a mask or of a saved phi, into a PNG file.\n\n"
    "  3d        the surface and, with --preset or --tf, the source as a volume rendering\n"
    "  axial, coronal, sagittal   a slice with the surface's outline\n"
    "  oblique   a slice across --normal\n"
    "  speed     the axial slice coloured by a term of the speed: orange where the surface grows, blue and\n"
    "            hatched where it shrinks\n"
    "  pages     which pages of the level set are resident\n"
    "  sheet     three slices, the speed map (with --target and --range) and the 3D view on one sheet\n\n"
    "Positions are voxel indices; normals and planes are in patient coordinates (LPS, mm): what lies where\n"
    "N . x > D of --clip is hidden.";
constexpr const char* kExamples =
    "  tidemark-cli render head.nii.gz --mask brain.nii.gz --out brain.png\n"
    "  tidemark-cli render study/ --preset ct-bone --camera 30,20 --size 800x800 --out bone.png\n"
    "  tidemark-cli render study/ --phi phi.nii.gz --view axial --at 0,0,40 --out slice.png\n"
    "  tidemark-cli render study/ --mask liver.nii.gz --preset ct-angio --roi inside --out vessels.png\n"
    "  tidemark-cli render study/ --mask liver.nii.gz --view sheet --size 1200x800 --out sheet.png\n";

constexpr std::int64_t kLargestPicture = 8192;

struct RenderOptions {
  std::string input;
  std::string series;
  std::string mask;
  std::string phi;
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
  std::optional<std::vector<double>> window;
  std::optional<double> target;
  std::optional<double> range;
  std::optional<double> alpha;
  std::string term = "data";
  std::string colour = "plain";
  std::optional<double> opacity;
  std::optional<double> occlusion;
  bool fit = false;
  bool nearest = false;
  bool annotate = false;
  std::string out;
};

// A word of an option and what it means.
template <class Value>
using Words = std::initializer_list<std::pair<const char*, Value>>;

const Words<Region> kRegions{{"off", Region::everywhere},
                             {"inside", Region::inside},
                             {"outside", Region::outside},
                             {"tinted", Region::tinted}};
const Words<SpeedTerm> kTerms{{"data", SpeedTerm::data},
                              {"curvature", SpeedTerm::curvature},
                              {"rescaling", SpeedTerm::rescaling},
                              {"total", SpeedTerm::total}};
const Words<SurfaceColouring> kColourings{{"plain", SurfaceColouring::plain},
                                          {"data", SurfaceColouring::data},
                                          {"curvature-term", SurfaceColouring::curvature_term},
                                          {"rescaling", SurfaceColouring::rescaling},
                                          {"total", SurfaceColouring::total_speed},
                                          {"curvature", SurfaceColouring::curvature},
                                          {"pages", SurfaceColouring::pages}};
const Words<int> kViews{{"3d", 0},      {"axial", 1}, {"coronal", 2}, {"sagittal", 3},
                        {"oblique", 4}, {"speed", 5}, {"pages", 6},   {"sheet", 7}};
const Words<Mode> kModes{{"raycast", Mode::raycast}, {"slices", Mode::slices}};
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

Result<PictureSize> parse_size(const std::string& text) {
  const std::size_t cross = text.find('x');
  if (cross != std::string::npos) {
    const auto width = parse_count(text.substr(0, cross));
    const auto height = parse_count(text.substr(cross + 1));
    if (width && height && *width >= 16 && *height >= 16 && *width <= kLargestPicture &&
        *height <= kLargestPicture) {
      return PictureSize{*width, *height};
    }
  }
  return fail(ErrorKind::usage, "--size {}: WIDTHxHEIGHT is needed, each from 16 to {} pixels", text,
              kLargestPicture);
}

Result<Camera> parse_camera(const std::string& text) {
  for (const std::size_t count : {2U, 3U}) {
    const auto numbers = parse_numbers(text, count);
    if (!numbers) continue;
    Camera camera;
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

// phi of the mask or the saved phi; outside everywhere without either.
Result<Field> surface_of(const RenderOptions& options, const Volume& source, Console& console) {
  const double band = default_band(source.geometry);
  if (!options.mask.empty()) {
    auto mask = load_mask(options.mask, console.progress());
    if (!mask) return pass_on(mask);
    auto aligned = onto_grid(std::move(*mask), source.geometry, options.mask);
    if (!aligned) return pass_on(aligned);
    return distance_transform(*aligned, band);
  }
  if (!options.phi.empty()) {
    const auto phi = load_volume(options.phi, {}, console.progress());
    if (!phi) return tl::unexpected<Error>(phi.error());
    auto values = onto_grid(*phi, source.geometry, options.phi);
    if (!values) return pass_on(values);
    const auto [low, high] = phi->range();
    if (low > 0.0F || high <= 0.0F)
      return fail(ErrorKind::input, "{}: phi has one sign: there is no surface", options.phi);
    // Distances beyond the band add nothing to a picture, and would make pages of the whole volume.
    return Field::from_dense(source.geometry, *values,
                             std::min(band, static_cast<double>(std::max(-low, high))));
  }
  return Field::empty(source.geometry, band);
}

WindowLevel window_of(const RenderOptions& options, const Volume& source) {
  if (options.window) return {(*options.window)[0], (*options.window)[1]};
  return tidemark::window_of(source);
}

bool has_surface(const RenderOptions& options) {
  return !options.mask.empty() || !options.phi.empty();
}

bool has_speed(const RenderOptions& options) {
  return options.target && options.range;
}

Result<ClipPlane> clip_plane(const RenderOptions& options) {
  const std::vector<double>& c = *options.clip;
  const glm::dvec3 normal(c[0], c[1], c[2]);
  const double length = glm::length(normal);
  if (length <= 0.0) return fail(ErrorKind::usage, "--clip: the plane needs a normal");
  const auto clipped = meaning("--clipped", options.clipped, kClipped);
  if (!clipped) return tl::unexpected<Error>(clipped.error());
  ClipPlane plane;
  plane.normal = normal / length;
  plane.offset_mm = c[3] / length;
  plane.clips_source = *clipped != 2;
  plane.clips_surface = *clipped != 1;
  return plane;
}

Result<TransferFunction> transfer_function(const RenderOptions& options) {
  auto function =
      options.preset.empty() ? TransferFunction::load(options.transfer_function) : preset(options.preset);
  if (function && function->source_needs_phi() && !has_surface(options)) {
    return fail(ErrorKind::usage, "'{}' looks at the surface: give --mask or --phi", function->name);
  }
  return function;
}

// What needs no volume yet.
Result<VolumeView> volume_view(const RenderOptions& options) {
  VolumeView view;
  const auto mode = meaning("--mode", options.mode, kModes);
  if (!mode) return tl::unexpected<Error>(mode.error());
  view.mode = *mode;
  const auto camera = parse_camera(options.camera);
  if (!camera) return tl::unexpected<Error>(camera.error());
  view.camera = *camera;
  if (!options.preset.empty() || !options.transfer_function.empty()) {
    auto function = transfer_function(options);
    if (!function) return pass_on(function);
    view.source = std::move(*function);
  }
  const auto region = meaning("--roi", options.region, kRegions);
  if (!region) return tl::unexpected<Error>(region.error());
  view.region = *region;
  const auto colouring = meaning("--colour", options.colour, kColourings);
  if (!colouring) return tl::unexpected<Error>(colouring.error());
  view.colouring = *colouring;
  view.surface = has_surface(options);
  if (options.opacity) view.surface_colour.a = static_cast<float>(*options.opacity);
  if (options.occlusion) view.lighting.occlusion = *options.occlusion;
  if (auto clipped = meaning("--clipped", options.clipped, kClipped); !clipped) return pass_on(clipped);
  if (options.clip) {
    const auto plane = clip_plane(options);
    if (!plane) return tl::unexpected<Error>(plane.error());
    view.clip = *plane;
  }
  return view;
}

Result<SliceView> slice_view(const RenderOptions& options) {
  SliceView view;
  if (options.view == "coronal") view.orientation = kCoronal;
  if (options.view == "sagittal") view.orientation = kSagittal;
  if (options.view == "oblique") {
    const std::vector<double>& n = *options.normal;
    if (glm::length(glm::dvec3(n[0], n[1], n[2])) <= 0.0) {
      return fail(ErrorKind::usage, "--normal: must not be 0");
    }
    view.orientation = oblique({n[0], n[1], n[2]});
  }
  if (options.view == "speed") view.content = SliceContent::speed;
  if (options.view == "pages") view.content = SliceContent::pages;
  const auto term = meaning("--term", options.term, kTerms);
  if (!term) return tl::unexpected<Error>(term.error());
  view.term = *term;
  view.nearest = options.nearest;
  return view;
}

struct Views {
  VolumeView volume;
  SliceView slice;
};

// All options, whether the view that is asked for uses them or not, before anything long is begun.
Result<Views> views_of(const RenderOptions& options) {
  const auto volume = volume_view(options);
  if (!volume) return tl::unexpected<Error>(volume.error());
  const auto slice = slice_view(options);
  if (!slice) return tl::unexpected<Error>(slice.error());
  return Views{*volume, *slice};
}

// What depends on the study: where the middle is and which values are common.
void place(Views& views, const RenderOptions& options, const Volume& source, const Field& phi,
           double aspect) {
  views.volume.window = views.slice.window = window_of(options, source);
  if (options.fit) views.volume.camera = views.volume.camera.on(box_around(phi), source.geometry, aspect);
  views.slice.position_mm = middle_of(phi.mask());
  if (options.at) {
    views.slice.position_mm =
        source.geometry.to_patient({(*options.at)[0], (*options.at)[1], (*options.at)[2]});
  }
}

Status check(const RenderOptions& options) {
  if (auto view = meaning("--view", options.view, kViews); !view) return pass_on(view);
  if (!options.mask.empty() && !options.phi.empty()) {
    return fail(ErrorKind::usage, "--mask and --phi exclude each other");
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
    return fail(ErrorKind::usage, "a term of the speed needs --target and --range");
  if (options.window && !((*options.window)[1] > 0.0)) {
    return fail(ErrorKind::usage, "--window: the width must be above 0");
  }
  if (options.target.has_value() != options.range.has_value()) {
    return fail(ErrorKind::usage, "--target and --range belong together");
  }
  if ((options.region == "inside" || options.region == "outside") && !has_surface(options)) {
    return fail(ErrorKind::usage, "--roi {} needs --mask or --phi", options.region);
  }
  if (options.view == "3d" && !has_surface(options) && options.preset.empty() &&
      options.transfer_function.empty()) {
    return fail(ErrorKind::usage, "nothing to show: give --mask, --phi, --preset or --tf");
  }
  return {};
}

// Labels are numbered anew from 1 in the order of their values, so that any numbering gets colours.
Result<std::vector<std::uint8_t>> load_labels(const std::string& file, const Geometry& grid,
                                              Console& console) {
  const auto volume = load_volume(file, {}, console.progress());
  if (!volume) return tl::unexpected<Error>(volume.error());
  const auto values = onto_grid(*volume, grid, file);
  if (!values) return tl::unexpected<Error>(values.error());
  std::map<float, std::uint8_t> numbers;
  for (const float value : *values) {
    if (value == 0.0F || numbers.contains(value)) continue;
    if (value != std::round(value)) return fail(ErrorKind::input, "{}: {} is not a label", file, value);
    if (numbers.size() == 255) return fail(ErrorKind::input, "{}: more than 255 labels", file);
    numbers[value] = 0;
  }
  std::uint8_t next = 0;
  for (auto& [value, number] : numbers) number = ++next;
  numbers[0.0F] = 0;
  std::vector<std::uint8_t> labels(values->size());
  std::transform(values->begin(), values->end(), labels.begin(), [&](float value) { return numbers[value]; });
  return labels;
}

// The 3D view of a sheet is two or three of its three columns wide, and one of its two rows high.
double volume_aspect(const RenderOptions& options, PictureSize size) {
  return options.view == "sheet" ? size.aspect() * (has_speed(options) ? 4.0 / 3.0 : 2.0) : size.aspect();
}

Result<Picture> draw(Renderer& renderer, const RenderOptions& options, const Views& views, PictureSize size,
                     const Progress& progress) {
  if (options.view == "sheet") {
    const SheetView sheet{views.slice.position_mm, views.slice.window, has_speed(options), views.slice.term,
                          views.volume};
    return draw_sheet(renderer, sheet, size, progress);
  }
  if (options.view == "3d") {
    return options.annotate ? draw_annotated(renderer, views.volume, size, progress)
                            : draw_still(renderer, views.volume, size, progress);
  }
  return options.annotate ? draw_annotated(renderer, views.slice, size, progress)
                          : renderer.draw(views.slice, size, progress);
}

bool is_even(const Picture& picture) {
  const auto& pixels = picture.pixels;
  return std::equal(pixels.begin() + 4, pixels.end(), pixels.begin());
}

Status run(Program& program, const RenderOptions& options) {
  Console& console = program.console;
  if (Status good = check(options); !good) return good;
  const auto size = parse_size(options.size);
  if (!size) return tl::unexpected<Error>(size.error());
  auto views = views_of(options);
  if (!views) return pass_on(views);
  Parameters parameters;
  if (options.target) parameters.target = *options.target;
  if (options.range) parameters.range = *options.range;
  if (options.alpha) parameters.alpha = *options.alpha;
  if (Status good = tidemark::check(parameters); !good) return good;
  Outputs outputs;
  if (Status announced = outputs.announce_png("--out", options.out); !announced) return announced;
  auto loaded = load_volume(options.input, options.series, console.progress());
  if (!loaded) return pass_on(loaded);
  const auto source = std::make_shared<const Volume>(std::move(*loaded));
  const auto phi = surface_of(options, *source, console);
  if (!phi) return tl::unexpected<Error>(phi.error());
  if (console.interrupted()) return cancelled_error();

  auto device = gpu::Device::create_headless({gpu::GlVersion::gl33, false});
  if (!device) return pass_on(device);
  auto renderer = Renderer::create(*device, source, phi->layout);
  if (!renderer) return pass_on(renderer);
  if (Status shown = (*renderer)->set_phi(*phi); !shown) return shown;
  (*renderer)->set_parameters(parameters);
  if (!options.labels.empty()) {
    const auto labels = load_labels(options.labels, source->geometry, console);
    if (!labels) return tl::unexpected<Error>(labels.error());
    if (Status taken = (*renderer)->set_labels(*labels); !taken) return taken;
  }
  place(*views, options, *source, *phi, volume_aspect(options, *size));
  const auto picture = draw(**renderer, options, *views, *size, console.progress());
  if (!picture) return tl::unexpected<Error>(picture.error());
  if (is_even(*picture)) console.warn("the picture shows nothing but its background");
  const auto write = [&](const std::filesystem::path& name) {
    return write_png_file(picture->width, picture->height, picture->pixels, name);
  };
  if (Status staged = outputs.stage(options.out, write); !staged) return staged;
  if (Status done = outputs.commit(); !done) return done;
  console.say("Picture    {} x {} pixels in {}", picture->width, picture->height, options.out);
  Json object;
  object["file"] = options.out;
  object["width"] = picture->width;
  object["height"] = picture->height;
  console.result(object);
  return {};
}

}  // namespace

void add_render(CLI::App& app, Program& program) {
  auto options = std::make_shared<RenderOptions>();
  CLI::App& command = add_command(app, program, {"render", kSummary, kDescription, kExamples},
                                  [&program, options] { return run(program, *options); });
  command.add_option("INPUT", options->input, "DICOM folder or file, or a volume file")->required();
  command.add_option("--series", options->series, "UID of the series, where INPUT holds several");
  command.add_option("--mask", options->mask, "Mask whose surface is shown");
  command.add_option("--phi", options->phi,
                     "Saved level set whose surface is shown: above 0 inside, in smallest voxels");
  command.add_option("--labels", options->labels, "Labels, shown as colours on slices");
  command.add_option("--view", options->view, "What is drawn (default: 3d)")->type_name(joined(kViews, "|"));
  command.add_option("--preset", options->preset,
                     "Volume rendering: " + fmt::format("{}", fmt::join(preset_names(), ", ")));
  command.add_option("--tf", options->transfer_function,
                     "Volume rendering: a transfer function of your own, as JSON");
  command.add_option("--roi", options->region, "Where the volume rendering shows: off is everywhere")
      ->type_name(joined(kRegions, "|"));
  command.add_option("--colour", options->colour, "What colours the surface (default: plain)")
      ->type_name(joined(kColourings, "|"));
  command.add_option("--opacity", options->opacity, "Of the surface, 0 to 1 (default: 1)");
  command.add_option("--occlusion", options->occlusion, "How much hollows of the surface darken, 0 to 1");
  add_numbers(command, "--clip", "NX,NY,NZ,D", options->clip, "Clip plane in the patient (LPS, mm)");
  command.add_option("--clipped", options->clipped, "What it cuts (default: both)")
      ->type_name(joined(kClipped, "|"));
  add_numbers(command, "--normal", "NX,NY,NZ", options->normal, "Across the oblique slice (LPS)");
  add_numbers(command, "--at", "I,J,K", options->at,
              "A voxel that the slice goes through (default: the middle of the surface, or of the volume)");
  add_numbers(command, "--window", "CENTRE,WIDTH", options->window,
              "Window in the source's units (default: the file's)");
  command.add_flag("--nearest", options->nearest, "Slices show voxels as they are, not interpolated");
  add_number(command, "--target", options->target, "T, for the speed");
  add_number(command, "--range", options->range, "epsilon, for the speed");
  add_number(command, "--alpha", options->alpha, "alpha, for the speed (default: 0.5)");
  command.add_option("--term", options->term, "What --view speed shows (default: data, which is D(I))")
      ->type_name(joined(kTerms, "|"));
  command.add_option("--camera", options->camera,
                     "AZIMUTH,ELEVATION[,ZOOM] in degrees: 0,0 looks from the front (default); azimuth goes\n"
                     "towards the patient's left, elevation towards the head");
  command.add_option("--mode", options->mode, "How 3D pictures are made (default: raycast)")
      ->type_name(joined(kModes, "|"));
  command.add_flag("--fit", options->fit, "The camera looks at the pages around the surface and comes near");
  command.add_flag("--annotate", options->annotate, "Orientation letters and a scale bar");
  command.add_option("--size", options->size, "Pixels (default: 512x512)")->type_name("WxH");
  command.add_option("--out", options->out, "Picture, .png")->required();
}

}  // namespace tidemark::cli
