// tidemark-cli render: a picture of a study and its surface.
#include <memory>

#include "app/cli/align.h"
#include "app/cli/arguments.h"
#include "app/cli/outputs.h"
#include "app/cli/program.h"
#include "gpu/device.h"
#include "imaging/files/png_file.h"
#include "imaging/study.h"
#include "renderer/overview.h"
#include "solver/distance_transform.h"
#include "solver/model.h"

namespace tidemark::cli {
namespace {

constexpr const char* kSummary = "Draws a picture of a study and its surface";
constexpr const char* kDescription =
    "Draws INPUT, with the surface of a mask or of a saved phi, into a PNG file. 3d: the surface, and with\n"
    "--preset or --tf the source as a volume rendering. axial, coronal, sagittal: a slice with the "
    "surface's\n"
    "outline. speed: the axial slice coloured by D(I), orange where the surface grows, blue and hatched "
    "where it\n"
    "shrinks. pages: which pages are resident. Positions are voxel indices, NX,NY,NZ,D of the clip plane "
    "patient\n"
    "coordinates (LPS, mm): what lies where N . x > D is hidden.";
constexpr const char* kExamples =
    "  tidemark-cli render head.nii.gz --mask brain.nii.gz --out brain.png\n"
    "  tidemark-cli render study/ --preset ct-bone --camera 30,20 --size 800x800 --out bone.png\n"
    "  tidemark-cli render study/ --phi phi.nii.gz --view axial --at 0,0,40 --out slice.png\n";

constexpr std::int64_t kLargestPicture = 8192;

struct RenderOptions {
  std::string input;
  std::string series;
  std::string mask;
  std::string phi;
  std::string view = "3d";
  std::string preset;
  std::string transfer_function;
  std::string region = "off";
  std::string size = "512x512";
  std::optional<std::vector<double>> clip;
  std::optional<std::vector<double>> at;
  std::string camera = "0,0";
  std::optional<std::vector<double>> window;
  std::optional<double> target;
  std::optional<double> range;
  std::optional<double> opacity;
  std::string out;
};

struct PictureSize {
  std::int64_t width = 0;
  std::int64_t height = 0;
};

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
    Camera camera{(*numbers)[0], (*numbers)[1], count == 3 ? (*numbers)[2] : 1.0};
    if (camera.zoom > 0.0) return camera;
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
    return Field::from_dense(source.geometry, *values,
                             static_cast<double>(std::max(std::abs(low), std::abs(high))));
  }
  return Field::empty(source.geometry, band);
}

WindowLevel window_of(const RenderOptions& options, const Volume& source) {
  if (options.window) return {(*options.window)[0], (*options.window)[1]};
  return tidemark::window_of(source);
}

Result<VolumeView> volume_view(const RenderOptions& options, const Volume& source) {
  VolumeView view;
  const auto camera = parse_camera(options.camera);
  if (!camera) return tl::unexpected<Error>(camera.error());
  view.camera = *camera;
  if (!options.preset.empty() || !options.transfer_function.empty()) {
    auto function =
        options.preset.empty() ? TransferFunction::load(options.transfer_function) : preset(options.preset);
    if (!function) return pass_on(function);
    view.source = std::move(*function);
  }
  if (options.region == "inside") view.region = Region::inside;
  if (options.region == "outside") view.region = Region::outside;
  view.surface = !options.mask.empty() || !options.phi.empty();
  if (options.opacity) view.surface_colour.a = static_cast<float>(*options.opacity);
  if (options.clip) {
    const std::vector<double>& c = *options.clip;
    const glm::dvec3 normal(c[0], c[1], c[2]);
    const double length = glm::length(normal);
    if (length <= 0.0) return fail(ErrorKind::usage, "--clip: the plane needs a normal");
    view.clip = ClipPlane{normal / length, c[3] / length};
  }
  view.window = window_of(options, source);
  return view;
}

Result<SliceView> slice_view(const RenderOptions& options, const Volume& source) {
  SliceView view;
  if (options.view == "coronal") view.plane = SlicePlane::coronal;
  if (options.view == "sagittal") view.plane = SlicePlane::sagittal;
  if (options.view == "speed") view.content = SliceContent::speed;
  if (options.view == "pages") view.content = SliceContent::pages;
  if (view.content == SliceContent::speed && (!options.target || !options.range)) {
    return fail(ErrorKind::usage, "--view speed needs --target and --range");
  }
  view.position_mm = middle_of(source.geometry);
  if (options.at) {
    view.position_mm = source.geometry.to_patient({(*options.at)[0], (*options.at)[1], (*options.at)[2]});
  }
  view.window = window_of(options, source);
  return view;
}

Status check(const RenderOptions& options) {
  const std::vector<std::string> views = {"3d", "axial", "coronal", "sagittal", "speed", "pages"};
  if (std::find(views.begin(), views.end(), options.view) == views.end()) {
    return fail(ErrorKind::usage, "--view '{}' is unknown; use {}", options.view, fmt::join(views, ", "));
  }
  if (options.region != "off" && options.region != "inside" && options.region != "outside") {
    return fail(ErrorKind::usage, "--roi '{}' is unknown; use off, inside or outside", options.region);
  }
  if (!options.mask.empty() && !options.phi.empty()) {
    return fail(ErrorKind::usage, "--mask and --phi exclude each other");
  }
  if (!options.preset.empty() && !options.transfer_function.empty()) {
    return fail(ErrorKind::usage, "--preset and --tf exclude each other");
  }
  if (options.opacity && (*options.opacity < 0.0 || *options.opacity > 1.0)) {
    return fail(ErrorKind::usage, "--opacity {}: must be 0 to 1", *options.opacity);
  }
  if (options.view == "3d" && options.mask.empty() && options.phi.empty() && options.preset.empty() &&
      options.transfer_function.empty()) {
    return fail(ErrorKind::usage, "nothing to show: give --mask, --phi, --preset or --tf");
  }
  return {};
}

Status run(Program& program, const RenderOptions& options) {
  Console& console = program.console;
  if (Status good = check(options); !good) return good;
  const auto size = parse_size(options.size);
  if (!size) return tl::unexpected<Error>(size.error());
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
  auto renderer = Renderer::create(*device, source, *phi);
  if (!renderer) return pass_on(renderer);
  Result<Picture> picture = fail(ErrorKind::internal, "nothing drawn");
  if (options.view == "3d") {
    const auto view = volume_view(options, *source);
    if (!view) return tl::unexpected<Error>(view.error());
    picture = (*renderer)->draw(*view, size->width, size->height);
  } else {
    const auto view = slice_view(options, *source);
    if (!view) return tl::unexpected<Error>(view.error());
    Parameters parameters;
    if (options.target) parameters.target = *options.target;
    if (options.range) parameters.range = *options.range;
    if (Status good = tidemark::check(parameters); !good) return good;
    picture = (*renderer)->draw(*view, parameters, size->width, size->height);
  }
  if (!picture) return pass_on(picture);
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
  command.add_option("--phi", options->phi, "Saved level set whose surface is shown");
  command.add_option("--view", options->view, "What is drawn (default: 3d)")
      ->type_name("3d|axial|coronal|sagittal|speed|pages");
  command.add_option("--preset", options->preset,
                     "Volume rendering: " + fmt::format("{}", fmt::join(preset_names(), ", ")));
  command.add_option("--tf", options->transfer_function,
                     "Volume rendering: a transfer function of your own, as JSON");
  command
      .add_option("--roi", options->region,
                  "Where the volume rendering shows: off (everywhere), inside or outside")
      ->type_name("off|inside|outside");
  command.add_option("--opacity", options->opacity, "Of the surface, 0 to 1 (default: 1)");
  add_numbers(command, "--clip", "NX,NY,NZ,D", options->clip, "Clip plane in the patient (LPS, mm)");
  add_numbers(command, "--at", "I,J,K", options->at,
              "A voxel that the slice goes through (default: the middle)");
  add_numbers(command, "--window", "CENTRE,WIDTH", options->window,
              "Window in the source's units (default: the file's)");
  add_number(command, "--target", options->target, "T, for --view speed");
  add_number(command, "--range", options->range, "epsilon, for --view speed");
  command.add_option("--camera", options->camera,
                     "AZIMUTH,ELEVATION[,ZOOM] in degrees; 0,0 looks from the front (default)");
  command.add_option("--size", options->size, "Pixels (default: 512x512)")->type_name("WxH");
  command.add_option("--out", options->out, "Picture, .png")->required();
}

}  // namespace tidemark::cli
