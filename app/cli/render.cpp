// tidemark-cli render: a picture of a study and its surface.
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

#include "app/cli/outputs.h"
#include "app/cli/program.h"
#include "app/cli/render_options.h"
#include "app/cli/renderer_option.h"
#include "imaging/files/png_file.h"
#include "imaging/load_study.h"
#include "imaging/onto_grid.h"
#include "imaging/results/results.h"
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
    "  sheet     three slices, the speed map (with --target and --range, or --speed) and the 3D view on one "
    "sheet\n\n"
    "Positions are voxel indices; normals and planes are in patient coordinates (LPS, mm): what lies where\n"
    "N . x > D of --clip is hidden.";
constexpr const char* kExamples =
    "  tidemark-cli render head.nii.gz --mask brain.nii.gz --out brain.png\n"
    "  tidemark-cli render study/ --preset ct-bone --camera 30,20 --size 800x800 --out bone.png\n"
    "  tidemark-cli render study/ --phi phi.nii.gz --view axial --at 0,0,40 --out slice.png\n"
    "  tidemark-cli render study/ --mask liver.nii.gz --preset ct-angio --roi inside --out vessels.png\n"
    "  tidemark-cli render study/ --mask liver.nii.gz --view sheet --size 1200x800 --out sheet.png\n";
// phi of the mask or the saved phi; outside everywhere without either.
Result<solver::Field> surface_of(const RenderOptions& options, const Volume& source, Console& console) {
  const double band = solver::default_band(source.geometry);
  if (!options.mask.empty()) {
    const auto loaded = imaging::load_any_mask(options.mask, &source.geometry, console.progress());
    if (!loaded) return tl::unexpected<Error>(loaded.error());
    for (const std::string& change : loaded->changes) console.warn(options.mask + ": " + change);
    return solver::distance_transform(loaded->mask, band);
  }
  if (!options.phi.empty()) {
    const auto phi = imaging::load_volume(options.phi, {}, console.progress());
    if (!phi) return tl::unexpected<Error>(phi.error());
    auto values = imaging::onto_grid(*phi, source.geometry, options.phi);
    if (!values) return pass_on(values);
    const auto [low, high] = phi->range();
    if (low > 0.0F || high <= 0.0F)
      return fail(ErrorKind::input, "{}: phi has one sign: there is no surface", options.phi);
    // Distances beyond the band add nothing to a picture, and would make pages of the whole volume.
    return solver::Field::from_dense(source.geometry, *values,
                                     std::min(band, static_cast<double>(std::max(-low, high))));
  }
  return solver::Field::empty(source.geometry, band);
}
WindowLevel window_of(const RenderOptions& options, const Volume& source) {
  if (options.window) return {(*options.window)[0], (*options.window)[1]};
  return tidemark::renderer::window_of(source);
}
// Fills in the facts of the study: its middle and its common values.
void place(Views& views, const RenderOptions& options, const Volume& source, const solver::Field& phi,
           double aspect) {
  views.volume.window = views.slice.window = window_of(options, source);
  if (options.fit)
    views.volume.camera = views.volume.camera.on(renderer::box_around(phi), source.geometry, aspect);
  views.slice.position_mm = renderer::middle_of(phi.mask());
  if (options.at) {
    views.slice.position_mm =
        source.geometry.to_patient({(*options.at)[0], (*options.at)[1], (*options.at)[2]});
  }
}
// Labels are numbered anew from 1 in the order of their values, so that any numbering gets colours.
Result<std::vector<std::uint8_t>> load_labels(const std::string& file, const Geometry& grid,
                                              Console& console) {
  const auto volume = imaging::load_volume(file, {}, console.progress());
  if (!volume) return tl::unexpected<Error>(volume.error());
  const auto values = imaging::onto_grid(*volume, grid, file);
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
double volume_aspect(const RenderOptions& options, renderer::PictureSize size) {
  return options.view == "sheet" ? size.aspect() * (has_speed(options) ? 4.0 / 3.0 : 2.0) : size.aspect();
}

Result<renderer::Picture> draw(renderer::Renderer& renderer, const RenderOptions& options, const Views& views,
                               const Progress& progress) {
  const renderer::PictureSize size = views.size;
  if (options.view == "sheet") {
    const renderer::SheetView sheet{views.slice.position_mm, views.slice.window, has_speed(options),
                                    views.slice.term, views.volume};
    return renderer::draw_sheet(renderer, sheet, size, progress);
  }
  if (options.view == "3d") {
    return options.annotate ? renderer::draw_annotated(renderer, views.volume, size, progress)
                            : renderer::draw_still(renderer, views.volume, size, progress);
  }
  return options.annotate ? renderer::draw_annotated(renderer, views.slice, size, progress)
                          : renderer.draw(views.slice, size, progress);
}

// What drives the surface, for views of the speed, and what holds it, for slices.
Status show_drive(renderer::Renderer& renderer, const DriveOptions& options,
                  const std::shared_ptr<const Volume>& source, const solver::Parameters& parameters,
                  const solver::Field& phi, Console& console) {
  const auto drive = make_drive(options, source->geometry, console);
  if (!drive) return tl::unexpected<Error>(drive.error());
  if (*drive == nullptr) return {};
  auto speed = document::make_speed(**drive, source, parameters, console.progress());
  if (!speed) return pass_on(speed);
  if (*speed != nullptr && (*speed)->follows_surface()) {
    if (auto following = (*speed)->following(phi)) *speed = std::move(following);
  }
  renderer.set_speed(std::move(*speed));
  return renderer.set_constraints((*drive)->constraints.get());
}

bool is_even(const renderer::Picture& picture) {
  const auto& pixels = picture.pixels;
  return std::equal(pixels.begin() + 4, pixels.end(), pixels.begin());
}

Status run(Program& program, const RenderOptions& options) {
  Console& console = program.console;
  auto views = views_of(options);
  if (!views) return pass_on(views);
  Outputs outputs;
  TIDEMARK_TRY(outputs.announce_png("--out", options.out));
  const auto chosen = choose_renderer(options.renderer);
  if (!chosen) return tl::unexpected<Error>(chosen.error());
  auto loaded = load_study(options.study, console.progress());
  if (!loaded) return pass_on(loaded);
  const auto source = std::make_shared<const Volume>(std::move(loaded->volume));
  auto surface = surface_of(options, *source, console);
  if (!surface) return pass_on(surface);
  const auto phi = std::make_shared<const solver::Field>(std::move(*surface));
  if (console.interrupted()) return cancelled_error();

  auto renderer = renderer::make_renderer(chosen->kind, chosen->device, source, phi->layout);
  if (!renderer) return pass_on(renderer);
  TIDEMARK_TRY((*renderer)->set_phi(phi, {}));
  (*renderer)->set_parameters(views->parameters);
  TIDEMARK_TRY(show_drive(**renderer, options.drive, source, views->parameters, *phi, console));
  if (!options.labels.empty()) {
    const auto labels = load_labels(options.labels, source->geometry, console);
    if (!labels) return tl::unexpected<Error>(labels.error());
    TIDEMARK_TRY((*renderer)->set_labels(*labels));
  }
  place(*views, options, *source, *phi, volume_aspect(options, views->size));
  const auto picture = draw(**renderer, options, *views, console.progress());
  if (!picture) return tl::unexpected<Error>(picture.error());
  if (is_even(*picture)) console.warn("the picture shows nothing but its background");
  const auto write = [&](const std::filesystem::path& name) {
    return imaging::write_png_file(picture->width, picture->height, picture->pixels, name);
  };
  TIDEMARK_TRY(outputs.stage(options.out, write));
  TIDEMARK_TRY(outputs.commit());
  console.say("Picture    {} x {} pixels in {}", picture->width, picture->height, options.out);
  Json object;
  object["file"] = options.out;
  object["width"] = picture->width;
  object["height"] = picture->height;
  object["renderer"] = (*renderer)->name();
  console.result(object);
  return {};
}

}  // namespace

void add_render(CLI::App& app, Program& program) {
  auto options = std::make_shared<RenderOptions>();
  CLI::App& command = add_command(app, program, {"render", kSummary, kDescription, kExamples},
                                  [&program, options] { return run(program, *options); });
  add_render_options(command, *options);
}

}  // namespace tidemark::cli
