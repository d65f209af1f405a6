#include "renderer/gl/gl_renderer.h"

#include <algorithm>
#include <glm/ext/matrix_transform.hpp>

#include "renderer/gl/source_plane.h"
#include "renderer/gl/uniforms.h"
#include "renderer/view_setup.h"
#include "solver/gl/step_uniforms.h"
#include "solver/speed/tent_speed.h"

namespace tidemark::renderer {
namespace {

// Texture units.
constexpr int kPhiUnit = 0;
constexpr int kSourceUnit = 3;
constexpr LabelPicture::Units kLabelUnits{5, 9, 10};
constexpr int kFreeUnit = 6;        // and the three behind it; the last has labels of pages for rays
constexpr int kConstraintUnit = 8;  // of slices, which need one of those
constexpr int kSpeedUnit = 13;
constexpr int kImagesUnit = 15;

solver::StepConstants<float> constants_of(const std::shared_ptr<const Volume>& source,
                                          const solver::Parameters& parameters) {
  const solver::TentSpeed tent(source, parameters);
  return solver::Model(source->geometry, parameters, tent).constants<float>();
}

gpu::Defines variant_of(const SliceView& view, bool source_by_plane) {
  gpu::Defines variant;
  if (source_by_plane) variant.emplace_back("SOURCE_PLANE", "");
  if (view.content == SliceContent::pages) variant.emplace_back("PAGES", "");
  if (view.content == SliceContent::speed) {
    variant.emplace_back(view.term == SpeedTerm::data    ? "DATA_SPEED"
                         : view.term == SpeedTerm::doubt ? "DOUBT"
                                                         : "SPEED",
                         "");
  }
  if (view.images && view.content == SliceContent::source) variant.emplace_back("IMAGES", "");
  return variant;
}

Result<gpu::Texture2D> texture_of(gpu::Device& device, const ImagesOver& images) {
  auto texture =
      gpu::Texture2D::create(device, gpu::TexelFormat::rgba8, images.width, images.height, "images");
  if (!texture) return texture;
  texture->upload({0, 0, images.width, images.height}, std::as_bytes(std::span(images.rgba)));
  texture->set_filter(gpu::Filter::linear);
  return texture;
}

}  // namespace

GlRenderer::GlRenderer(std::shared_ptr<gpu::Device> device, std::shared_ptr<const Volume> source)
    : device_(std::move(device)),
      source_(std::move(source)),
      constants_(constants_of(source_, solver::Parameters())),
      tent_(solver::tent_of(solver::Parameters())),
      maps_(source_->geometry.size) {}

Result<std::unique_ptr<GlRenderer>> GlRenderer::create(std::shared_ptr<gpu::Device> device,
                                                       std::shared_ptr<const Volume> source,
                                                       const PageLayout& layout) {
  if (layout.domain_size() != source->geometry.size) {
    return fail(ErrorKind::usage, "the pages are not those of the volume");
  }
  TIDEMARK_TRY(device->make_current());
  std::unique_ptr<GlRenderer> renderer(new GlRenderer(std::move(device), std::move(source)));
  gpu::Device& gl = *renderer->device_;
  auto slots = gpu::SamplerSlots::create(gl);
  if (!slots) return pass_on(slots);
  renderer->slots_ = std::move(*slots);
  auto source_picture = SourcePicture::create(gl, *renderer->source_, layout);
  if (!source_picture) return pass_on(source_picture);
  renderer->source_picture_ = std::move(*source_picture);
  auto phi = PhiPicture::create(gl, layout, solver::default_band(renderer->source_->geometry));
  if (!phi) return pass_on(phi);
  renderer->phi_ = std::move(*phi);
  auto labels = LabelPicture::create(gl, layout);
  if (!labels) return pass_on(labels);
  renderer->labels_ = std::move(*labels);
  TIDEMARK_TRY(renderer->set_phi(
      solver::Field::empty(renderer->source_->geometry, renderer->phi_.band(), layout.page_shape())));
  return renderer;
}

Status GlRenderer::set_phi(std::shared_ptr<const solver::Field> shown, std::span<const std::int64_t> quiet) {
  const solver::Field& phi = *shown;
  if (phi.geometry.size != source_->geometry.size || phi.layout != phi_.layout().layout()) {
    return fail(ErrorKind::usage, "phi and the volume differ in size or in pages");
  }
  TIDEMARK_TRY(device_->make_current());
  if (phi.band != phi_.band()) {
    auto anew = PhiPicture::create(*device_, phi.layout, phi.band);
    if (!anew) return pass_on(anew);
    phi_ = std::move(*anew);
  }
  slots_.clear();
  return phi_.update(*device_, phi, quiet);
}

Result<bool> GlRenderer::look_at(solver::Executor& executor,
                                 const std::optional<std::vector<std::int64_t>>& quiet) {
  TIDEMARK_TRY(device_->make_current());
  solver::PackedView view;
  if (!executor.packed_view(view)) return false;
  if (view.layout.layout() != phi_.layout().layout()) {
    return fail(ErrorKind::usage, "pictures and executor differ in pages");
  }
  if (view.band != static_cast<float>(phi_.band())) {
    auto anew = PhiPicture::create(*device_, phi_.layout().layout(), static_cast<double>(view.band));
    if (!anew) return pass_on(anew);
    phi_ = std::move(*anew);
  }
  TIDEMARK_TRY(phi_.look_at(*device_, view, quiet));
  return true;
}

void GlRenderer::set_parameters(const solver::Parameters& parameters) {
  constants_ = constants_of(source_, parameters);
  tent_ = solver::tent_of(parameters);
}

Status GlRenderer::set_constraints(const solver::Constraints* constraints) {
  TIDEMARK_TRY(device_->make_current());
  if (constraints == nullptr || constraints->empty()) {
    constraints_.reset();
    return {};
  }
  if (constraints->layout().domain_size() != source_->geometry.size) {
    return fail(ErrorKind::usage, "walls and anchors are on another grid than the volume");
  }
  if (!constraints_) {
    auto made = solver::ConstraintTexture::create(*device_, source_->geometry.size);
    if (!made) return pass_on(made);
    constraints_ = std::move(*made);
  }
  return constraints_->show(*device_, *constraints);
}

Status GlRenderer::set_labels(const PagedBytes& labels) {
  if (labels.size() != source_->geometry.size)
    return fail(ErrorKind::usage, "labels are on another grid than the volume");
  TIDEMARK_TRY(device_->make_current());
  labels_.set_voxels(labels);
  return {};
}

Status GlRenderer::set_label_colours(std::span<const LabelColour> colours) {
  if (colours.size() > kLabels) return fail(ErrorKind::usage, "there are more than {} labels", kLabels);
  TIDEMARK_TRY(device_->make_current());
  labels_.set_colours(colours);
  return {};
}

Result<const gpu::Program*> GlRenderer::find_program(const char* fragment, const gpu::Defines& variant) {
  constexpr std::size_t kMostPrograms = 32;  // each kind of transfer function makes another one
  std::string key = fragment;
  for (const auto& [name, value] : variant) key += fmt::format(" {}={}", name, value);
  auto found = programs_.find(key);
  if (found == programs_.end()) {
    gpu::Defines defines = phi_.layout().defines();
    gpu::add(defines, labels_.defines());
    defines.emplace_back("ANISOTROPIC", "");
    if (device_->capabilities().software) defines.emplace_back("SOFTWARE_RASTERISER", "");
    gpu::add(defines, variant);
    auto made = gpu::Program::render(*device_, "render/full_view.vert", "", fragment, defines);
    if (!made) return pass_on(made);
    if (programs_.size() == kMostPrograms) {
      programs_.erase(
          std::ranges::min_element(programs_, {}, [](const auto& named) { return named.second.used; }));
    }
    found = programs_.emplace(key, Made{std::move(*made)}).first;
  }
  found->second.used = ++uses_;
  return &found->second.program;
}

Result<const gpu::Program*> GlRenderer::use_program(const char* fragment, const gpu::Defines& variant,
                                                    const SpeedPicture* evaluated) {
  const auto found = find_program(fragment, variant);
  if (!found) return found;
  const gpu::Program& program = **found;
  slots_.clear();
  program.use();
  solver::set_step_uniforms(program, constants_);
  solver::set_tent_uniforms(program, maps_.tent() != nullptr ? *maps_.tent() : tent_);
  if (evaluated != nullptr) evaluated->set_uniforms(program, kSpeedUnit);
  phi_.set_uniforms(program, kPhiUnit);  // after the step's: the band is that of the phi shown
  source_picture_.set_uniforms(program, kSourceUnit);
  labels_.set_uniforms(program, kLabelUnits);
  program.set("spacing", glm::vec3(source_->geometry.spacing_mm));
  return &program;
}

// The view in the source's own units.
VolumeView GlRenderer::resolved(const VolumeView& asked) {
  if (asked.source && !common_range_) common_range_ = source_->common_range();
  return renderer::resolved(asked, common_range_.value_or(std::pair(0.0F, 1.0F)), maps_.has_change());
}

bool GlRenderer::shows_labels(const VolumeView& view) const {
  return labels_.pages().show_at(view.label_opacity);
}

Result<const gpu::Program*> GlRenderer::use_volume_program(const char* fragment, const VolumeView& view,
                                                           PictureSize size, gpu::Defines variant) {
  const bool source = shows_source(view);
  if (shows_labels(view)) {
    TIDEMARK_TRY(labels_.prepare(*device_, true));
  }
  const auto with = [&](bool wanted, const char* name) {
    if (wanted) variant.emplace_back(name, "");
  };
  with(view.surface, "SURFACE");
  with(shows_labels(view), "LABELS");
  with(source, "SOURCE");
  with(source && (view.region != Region::everywhere || view.source->source_needs_phi()), "REGION");
  with(source && view.source->source_needs_gradient(), "BY_GRADIENT");
  with(view.clip.has_value(), "CLIP");
  with(view.colouring != SurfaceColouring::plain, "SPEED_COLOURS");
  with(view.lighting.occlusion > 0.0, "OCCLUSION");
  with(source && view.quality.fast_gradient, "FAST_GRADIENT");
  with(!view.quality.skip_empty, "NO_SKIP");
  with(view.colouring == SurfaceColouring::change, "CHANGE");
  SpeedPicture* map = maps_.of(view);
  if (map != nullptr) {
    TIDEMARK_TRY(map->fill_pages(*device_, phi_.layout().layout(), phi_.page_entries()));
    gpu::add(variant, map->defines());
  }
  const gpu::Defines shading = shading_defines(view);
  variant.insert(variant.end(), shading.begin(), shading.end());
  const auto used = use_program(fragment, variant, map);
  if (!used) return used;
  const gpu::Program& program = **used;
  const Geometry& geometry = source_->geometry;
  set_shading(program, view, geometry);
  if (source) source_picture_.set_transfer_function(*source_, *view.source, view.region, phi_.band());
  program.set("voxel_from_view", glm::mat4(voxel_from_view(view, geometry, size)));
  program.set("pixel_mm", static_cast<float>(2.0 * view.camera.half_height_mm(geometry, size.aspect()) /
                                             static_cast<double>(size.height)));
  program.set("step_voxels", static_cast<float>(view.quality.step_voxels));
  program.set("jitter_round", view.quality.round);
  program.set("clip_surface", view.clip && view.clip->clips_surface ? 1 : 0);
  program.set("clip_source", view.clip && view.clip->clips_source ? 1 : 0);
  program.set("show_clip_picture", view.clip && view.clip->picture ? 1 : 0);
  program.set("colouring", static_cast<int>(view.colouring));
  program.set("occlusion", static_cast<float>(view.lighting.occlusion));
  program.set("label_opacity", static_cast<float>(view.label_opacity));
  program.set("background", view.background);
  return &program;
}

template <class View>
Result<Picture> GlRenderer::draw_and_read(const View& view, PictureSize size, const Progress& progress) {
  TIDEMARK_TRY(device_->make_current());
  if (canvas_.size() != size) {
    auto made = Canvas::create(*device_, size, gpu::TexelFormat::rgba8);
    if (!made) return pass_on(made);
    canvas_ = std::move(*made);
  }
  TIDEMARK_TRY(draw_on(canvas_, view, progress));
  return canvas_.read();
}

Result<Picture> GlRenderer::draw(const VolumeView& view, PictureSize size, const Progress& progress) {
  return draw_and_read(view, size, progress);
}

Result<Picture> GlRenderer::draw(const SliceView& view, PictureSize size, const Progress& progress) {
  return draw_and_read(view, size, progress);
}

Status GlRenderer::draw_on(Canvas& canvas, const VolumeView& asked, const Progress& progress) {
  TIDEMARK_TRY(device_->make_current());
  const VolumeView view = resolved(asked);
  if (view.mode == Mode::slices || !source_picture_.has_volume()) {
    return draw_from_slices(canvas, view, progress);
  }
  TIDEMARK_TRY(use_volume_program("render/volume.frag", view, canvas.size(), {}));
  return fill(canvas, progress);
}

Status GlRenderer::draw_from_slices(Canvas& canvas, const VolumeView& view, const Progress& progress) {
  const PictureSize size = canvas.size();
  const SliceAxis axis = SliceCaster::axis_for(view, source_->geometry);
  auto slab = use_volume_program("render/slab.frag", view, size, {axis.define()});
  if (!slab) return pass_on(slab);
  const std::vector<solver::PhysicalPage> table = phi_.page_entries();
  const SliceCaster::Scene scene{
      *source_, phi_, table, source_picture_.page_opacities(),
      shows_labels(view) ? labels_.pages().pages() : std::span<const std::int32_t>()};
  TIDEMARK_TRY(slice_caster_.draw(*device_, **slab, scene, view, size, {kPhiUnit, kFreeUnit}, progress));
  auto over = use_program("render/over_background.frag", {});
  if (!over) return pass_on(over);
  slice_caster_.layers().bind(kFreeUnit);
  (*over)->set("layers", kFreeUnit);
  (*over)->set("background", view.background);
  auto status = fill(canvas, progress);
  report_ = slice_caster_.report();
  return status;
}

Status GlRenderer::draw_on(Canvas& canvas, const SliceView& view, const Progress& progress) {
  TIDEMARK_TRY(device_->make_current());
  const PictureSize size = canvas.size();
  TIDEMARK_TRY(labels_.prepare(*device_, false));
  const bool by_plane = !source_picture_.has_volume();
  const glm::dmat4 voxel_from_view = slice_from_view(source_->geometry, view.orientation, view.position_mm,
                                                     view.zoom, view.pan_mm, size.aspect());
  gpu::Defines variant = variant_of(view, by_plane);
  SpeedPicture* map = maps_.of(view);
  if (map != nullptr) {
    TIDEMARK_TRY(map->fill_plane(*device_, voxel_from_view));
    gpu::add(variant, map->defines());
    if (view.content == SliceContent::source) variant.emplace_back("CHANGE", "");
  }
  if (constraints_) gpu::add(variant, constraints_->defines());
  auto program = use_program("render/slice.frag", variant, map);
  if (!program) return pass_on(program);
  const gpu::Program& slice = **program;
  if (constraints_) constraints_->set_uniforms(slice, kConstraintUnit);
  slice.set("voxel_from_view", glm::mat4(voxel_from_view));
  gpu::Texture2D plane;
  if (by_plane) {
    // Sums of terms are those of the nearest voxel; the map of D shows the source between voxels, whatever is
    // asked for.
    const bool is_speed = view.content == SliceContent::speed;
    const bool total = is_speed && view.term == SpeedTerm::total;
    const bool data = is_speed && view.term == SpeedTerm::data;
    const std::vector<float> values =
        source_on_plane(*source_, voxel_from_view, size, (view.nearest && !data) || total);
    auto made = gpu::Texture2D::create(*device_, gpu::TexelFormat::r32f, size.width, size.height,
                                       "source on a plane");
    if (!made) return pass_on(made);
    plane = std::move(*made);
    plane.upload({0, 0, size.width, size.height}, std::as_bytes(std::span(values)));
    plane.bind(kFreeUnit);
    slice.set("source_plane", kFreeUnit);
  }
  gpu::Texture2D images;
  if (view.images && view.content == SliceContent::source) {
    auto made = texture_of(*device_, *view.images);
    if (!made) return pass_on(made);
    images = std::move(*made);
    images.bind(kImagesUnit);
    slice.set("images", kImagesUnit);
    slice.set("images_from", static_cast<float>(view.images_from));
  }
  slice.set("window", glm::vec2(view.window.centre, view.window.width));
  slice.set("term", static_cast<int>(view.term));
  slice.set("nearest", view.nearest ? 1 : 0);
  slice.set("show_surface", view.surface ? 1 : 0);
  slice.set("show_contours", view.contours ? 1 : 0);
  slice.set("line_pixels", static_cast<float>(view.line_pixels));
  slice.set("label_opacity", labels_.pages().has_voxels() ? static_cast<float>(view.label_opacity) : 0.0F);
  slice.set("background", view.background);
  return fill(canvas, progress);
}

Result<std::optional<Hit>> GlRenderer::pick(const VolumeView& view, PictureSize size, glm::dvec2 pixel) {
  TIDEMARK_TRY(device_->make_current());
  VolumeView finely = resolved(view);
  finely.quality = {};
  if (!source_picture_.has_volume()) finely.source.reset();  // rays cannot see it
  const auto program = use_volume_program("render/volume.frag", finely, size, {{"PICK", ""}});
  if (!program) return pass_on(program);
  // The whole view of this program is the one pixel.
  const glm::dvec2 from_middle = pixel + 0.5 - 0.5 * glm::dvec2(size.width, size.height);
  const glm::dmat4 pixel_from_view =
      glm::scale(moved_by({from_middle.x, -from_middle.y}, size), glm::dvec3(0.0, 0.0, 1.0));
  const Geometry& geometry = source_->geometry;
  (*program)->set("voxel_from_view",
                  glm::mat4(view.camera.voxel_from_view(geometry, size.aspect()) * pixel_from_view));
  if (pick_canvas_.size() != PictureSize{1, 1}) {
    auto made = Canvas::create(*device_, {1, 1}, gpu::TexelFormat::rgba32f);
    if (!made) return pass_on(made);
    pick_canvas_ = std::move(*made);
  }
  TIDEMARK_TRY(pick_canvas_.fill(*device_, {}));
  glm::vec4 found(0.0F);
  TIDEMARK_TRY(pick_canvas_.colour().download({0, 0, 1, 1}, std::as_writable_bytes(std::span(&found, 1))));
  if (found.w == 0.0F) return std::optional<Hit>();
  const glm::dvec3 voxel(found);
  return std::optional<Hit>(
      Hit{static_cast<Hit::Kind>(static_cast<int>(found.w)), voxel, geometry.to_patient(voxel)});
}

// Draws with the program in use.
Status GlRenderer::fill(Canvas& canvas, const Progress& progress) {
  auto status = canvas.fill(*device_, progress);
  report_ = canvas.report();
  return status;
}

}  // namespace tidemark::renderer
