#include "app/cli/scene.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "app/cli/renderer_option.h"
#include "imaging/load_study.h"
#include "imaging/onto_grid.h"
#include "renderer/sheet.h"
#include "solver/distance_transform.h"
#include "solver/model.h"

namespace tidemark::cli {
namespace {

// phi of the mask or the saved phi; outside everywhere without either.
Result<solver::Field> surface_of(const RenderOptions& options, const StudyPlace& study, Console& console) {
  const double band = solver::default_band(study.grid);
  if (!options.mask.empty()) {
    const auto mask = read_mask(options.mask, study, console);
    if (!mask) return pass_on(mask);
    return solver::distance_transform(*mask, band);
  }
  if (!options.phi.empty()) {
    const auto phi = imaging::load_volume(options.phi, {}, console.progress());
    if (!phi) return pass_on(phi);
    auto values = imaging::onto_grid(*phi, study.grid, options.phi);
    if (!values) return pass_on(values);
    const auto [low, high] = phi->range();
    if (low > 0.0F || high <= 0.0F)
      return fail(ErrorKind::input, "{}: phi has one sign: there is no surface", options.phi);
    // Distances beyond the band add nothing to a picture, and would make pages of the whole volume.
    return solver::Field::from_dense(study.grid, *values,
                                     std::min(band, static_cast<double>(std::max(-low, high))));
  }
  return solver::Field::empty(study.grid, band);
}
WindowLevel window_of(const RenderOptions& options, const Volume& source) {
  if (options.window) return {(*options.window)[0], (*options.window)[1]};
  return tidemark::renderer::window_of(source);
}
// Labels are numbered anew from 1 in the order of their values, so that any numbering gets colours.
Result<std::vector<std::uint8_t>> load_labels(const std::string& file, const Geometry& grid,
                                              Console& console) {
  const auto volume = imaging::load_volume(file, {}, console.progress());
  if (!volume) return pass_on(volume);
  const auto values = imaging::onto_grid(*volume, grid, file);
  if (!values) return pass_on(values);
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

// What drives the surface, for views of the speed, and what holds it, for slices.
Status show_drive(const Scene& scene, const DriveOptions& options, const solver::Field& phi,
                  Console& console) {
  const auto drive = make_drive(options, scene.study, console);
  if (!drive) return pass_on(drive);
  if (*drive == nullptr) return {};
  auto speed = document::make_speed(**drive, scene.source, scene.views.parameters, console.progress());
  if (!speed) return pass_on(speed);
  if (*speed != nullptr && (*speed)->follows_surface()) {
    if (auto following = (*speed)->following(phi)) *speed = std::move(following);
  }
  scene.renderer->set_speed(std::move(*speed));
  return scene.renderer->set_constraints((*drive)->constraints.get());
}

}  // namespace

void place(Scene& scene, const RenderOptions& options, const solver::Field& phi) {
  Views& views = scene.views;
  const Volume& source = *scene.source;
  views.volume.window = views.slice.window = window_of(options, source);
  if (options.fit) {
    const double aspect = volume_aspect(options, views.size);
    views.volume.camera = views.volume.camera.on(renderer::box_around(phi), source.geometry, aspect);
  }
  views.slice.position_mm = renderer::middle_of(phi);
  if (options.at) {
    views.slice.position_mm =
        source.geometry.to_patient({(*options.at)[0], (*options.at)[1], (*options.at)[2]});
  }
}

bool goes_by_surface(const RenderOptions& options) {
  const bool has_volume = options.view == "3d" || options.view == "sheet";
  return (options.fit && has_volume) || (options.view != "3d" && !options.at);
}

Result<Scene> make_scene(const RenderOptions& options, Views views, Console& console,
                         const imaging::GridPolicy& otherwise) {
  const auto chosen = choose_renderer(options.renderer);
  if (!chosen) return pass_on(chosen);
  auto loaded = load_study(options.study, console.progress(), otherwise);
  if (!loaded) return pass_on(loaded);
  StudyPlace study = place_of(*loaded);
  Scene scene{std::make_shared<const Volume>(std::move(loaded->volume)), std::move(views), nullptr,
              std::move(study)};
  auto surface = surface_of(options, scene.study, console);
  if (!surface) return pass_on(surface);
  const auto phi = std::make_shared<const solver::Field>(std::move(*surface));
  if (console.interrupted()) return cancelled_error();

  auto renderer = renderer::make_renderer(chosen->kind, chosen->device, scene.source, phi->layout);
  if (!renderer) return pass_on(renderer);
  scene.renderer = std::move(*renderer);
  TIDEMARK_TRY(scene.renderer->set_phi(phi, {}));
  scene.renderer->set_parameters(scene.views.parameters);
  TIDEMARK_TRY(show_drive(scene, shown_drive(options), *phi, console));
  if (!options.labels.empty()) {
    const auto labels = load_labels(options.labels, scene.source->geometry, console);
    if (!labels) return pass_on(labels);
    TIDEMARK_TRY(scene.renderer->set_labels(PagedBytes(scene.source->geometry.size, *labels)));
    scene.views.volume.label_opacity = 1.0;
  }
  place(scene, options, *phi);
  return scene;
}

Result<renderer::Picture> draw(Scene& scene, const RenderOptions& options, const Progress& progress) {
  renderer::Renderer& renderer = *scene.renderer;
  const Views& views = scene.views;
  const renderer::PictureSize size = views.size;
  const bool is_oriented = scene.source->geometry.oriented;
  if (options.view == "sheet") {
    const renderer::SheetView sheet{views.slice.position_mm, views.slice.window, is_oriented,
                                    has_speed(options),      views.slice.term,   views.slice.nearest,
                                    views.slice.contours,    views.volume};
    return renderer::draw_sheet(renderer, sheet, size, progress);
  }
  if (options.view == "3d") {
    return options.annotate ? renderer::draw_annotated(renderer, views.volume, size, is_oriented, progress)
                            : renderer::draw_still(renderer, views.volume, size, progress);
  }
  return options.annotate ? renderer::draw_annotated(renderer, views.slice, size, is_oriented, progress)
                          : renderer.draw(views.slice, size, progress);
}

}  // namespace tidemark::cli
