// tidemark-cli segment: from a volume and a start to mask, surface and figures.
#include <filesystem>
#include <memory>

#include "app/cli/align.h"
#include "app/cli/program.h"
#include "app/cli/report.h"
#include "app/cli/segment_options.h"
#include "core/thread_pool.h"
#include "gpu/device.h"
#include "imaging/files/png_file.h"
#include "imaging/files/volume_file.h"
#include "imaging/filters/filters.h"
#include "imaging/filters/suggest_start.h"
#include "imaging/study.h"
#include "imaging/surface/surface.h"
#include "renderer/sheet.h"

namespace tidemark::cli {
namespace {

constexpr const char* kSummary = "Grows a surface from a start and writes mask, surface and figures";
constexpr const char* kDescription =
    "Segments INPUT: a surface starts at seeds or a mask, grows where brightness is within target -+ range\n"
    "(the volume's units, HU for CT), and is smoothed by its curvature. Voxel indices I,J,K are 0-based;\n"
    "radii, patient coordinates X,Y,Z (LPS) and smoothing are in mm. An interrupted run writes nothing.";

constexpr const char* kExamples =
    "  tidemark-cli segment brain/ --target 800 --range 120 --alpha 0.6 --seed 90,110,80,5 --out "
    "mask.nii.gz\n"
    "  tidemark-cli segment ct.nrrd --target 100 --range 40 --alpha 0.5 --seed-mm=-60,20,110,8 --smooth 1.5 "
    "\\\n"
    "      --out liver.nii.gz --out liver.stl --stats liver.json\n"
    "  tidemark-cli segment ct.nrrd --target 100 --range 40 --alpha 0.5 --init old.nii.gz --steps 200 "
    "--out-phi "
    "phi.nrrd\n"
    "  tidemark-cli segment ct.nrrd --target 100 --range 40 --alpha 0.5 --init-phi phi.nrrd --out "
    "new.nii.gz\n"
    "  tidemark-cli segment unknown/ --auto-start --out first-look.stl\n";

std::string count_of(const Geometry& geometry) {
  return fmt::format("{} x {} x {} voxels of {:.4g} x {:.4g} x {:.4g} mm", geometry.size.x, geometry.size.y,
                     geometry.size.z, geometry.spacing_mm.x, geometry.spacing_mm.y, geometry.spacing_mm.z);
}

// One run of the command.
class Segmentation {
 public:
  Segmentation(Program& program, SegmentOptions options)
      : console_(program.console), options_(std::move(options)) {}

  Status run();

 private:
  Status load();
  Status load_truth();
  Status suggest();
  Status evolve();
  Status write();
  Result<Picture> draw_picture();
  void say_warnings();

  Console& console_;
  SegmentOptions options_;
  Outputs outputs_;
  std::shared_ptr<const Volume> source_;  // as the solver sees it
  std::optional<Mask> truth_;
  Field phi_;
  Mask mask_;
  RunFigures figures_;
  std::shared_ptr<gpu::Device> device_;  // for the picture
};

Status Segmentation::run() {
  if (Status done = check(options_, outputs_); !done) return done;
  if (!options_.picture.empty()) {
    // Found out before the long work.
    auto device = gpu::Device::create_headless({gpu::GlVersion::gl33, false});
    if (!device) return pass_on(device);
    device_ = std::move(*device);
  }
  for (const auto step : {&Segmentation::load, &Segmentation::load_truth, &Segmentation::suggest,
                          &Segmentation::evolve, &Segmentation::write}) {
    if (Status done = (this->*step)(); !done) return done;
    if (console_.interrupted()) return cancelled_error();
  }
  if (Status done = outputs_.commit(); !done) return done;
  say(console_, figures_);
  for (const std::string& file : options_.out) console_.say("Wrote      {}", file);
  for (const std::string& file : {options_.out_phi, options_.picture, options_.stats}) {
    if (!file.empty()) console_.say("Wrote      {}", file);
  }
  say_warnings();
  console_.result(to_json(figures_));
  return {};
}

Status Segmentation::load() {
  auto volume = load_volume(options_.input, options_.series, console_.progress());
  if (!volume) return pass_on(volume);
  if (Status inside = check_inside(options_.start, volume->geometry); !inside) return inside;
  figures_.geometry = volume->geometry;
  figures_.modality = volume->modality;
  figures_.description = volume->description;
  figures_.series_uid = options_.series;
  figures_.changes = volume->changes;
  figures_.smooth_mm = options_.smooth_mm;
  console_.say("Loaded     {}{}{}, {}", volume->modality, volume->modality.empty() ? "" : ": ",
               count_of(volume->geometry), volume->scalar_name());
  for (const std::string& change : volume->changes) console_.say("           {}", change);
  if (options_.smooth_mm) {
    console_.log("smoothing by {} mm", *options_.smooth_mm);
    volume = smooth(*volume, *options_.smooth_mm);
    if (!volume) return pass_on(volume);
  }
  source_ = std::make_shared<const Volume>(std::move(*volume));
  return {};
}

Status Segmentation::load_truth() {
  if (!options_.truth) return {};
  auto labels = load_volume(*options_.truth, {}, console_.progress());
  if (!labels) return pass_on(labels);
  Mask mask{labels->geometry,
            std::vector<std::uint8_t>(static_cast<std::size_t>(labels->geometry.voxel_count()))};
  for (std::int64_t offset = 0; offset < labels->geometry.voxel_count(); ++offset) {
    const float value = labels->value(offset);
    const bool inside =
        options_.truth_label ? value == static_cast<float>(*options_.truth_label) : value != 0.0F;
    mask.voxels[static_cast<std::size_t>(offset)] = inside ? 1 : 0;
  }
  auto aligned = onto_grid(std::move(mask), source_->geometry, *options_.truth);
  if (!aligned) return pass_on(aligned);
  truth_ = std::move(*aligned);
  return {};
}

// Fills in what the user has left open.
Status Segmentation::suggest() {
  if (!options_.auto_start) return {};
  const bool needs_seed = !options_.start.given();
  if (!needs_seed && options_.target && options_.range && options_.alpha) return {};
  std::optional<Index3> looked_at;
  if (!options_.start.seeds.empty()) {
    const auto sphere = options_.start.seeds.front().resolve(source_->geometry);
    if (!sphere) return tl::unexpected<Error>(sphere.error());
    const glm::dvec3 voxel = source_->geometry.to_voxel(sphere->centre_mm);
    looked_at = glm::clamp(Index3(glm::round(voxel)), Index3(0), source_->geometry.size - Index3(1));
  }
  const auto found = suggest_start(*source_, looked_at, console_.progress());
  if (console_.interrupted()) return cancelled_error();
  if (!found) return fail(found.error().kind, "--auto-start: {}", found.error().message);
  if (needs_seed) {
    const std::string text =
        fmt::format("{},{},{},{:.4g}", found->voxel.x, found->voxel.y, found->voxel.z, found->radius_mm);
    options_.start.seeds.push_back({"--seed " + text, glm::dvec3(found->voxel), true, found->radius_mm});
    console_.say("Chose      --seed {}", text);
  }
  const auto fill = [&](const char* name, std::optional<double>& value, double suggestion) {
    if (value) return;
    value = suggestion;
    console_.say("Chose      {} {:.6g}", name, suggestion);
  };
  fill("--target", options_.target, found->target);
  fill("--range", options_.range, found->range);
  fill("--alpha", options_.alpha, found->alpha);
  return {};
}

Status Segmentation::evolve() {
  figures_.parameters = options_.parameters();
  figures_.start = describe(options_.start);
  auto executor =
      make_executor(options_.solver.kind, source_, figures_.parameters, options_.solver.executor_options());
  if (!executor) return pass_on(executor);
  Executor& solver = **executor;
  if (Status started = start(solver, *source_, options_.start, console_); !started) return started;
  console_.say("Start      {}", figures_.start);
  if (options_.step_limit() > 0) {
    Advance advance{options_.step_limit(), options_.until_converged(), console_.progress()};
    auto report = solver.advance(advance);
    if (!report) return pass_on(report);
    figures_.advance = *report;
  }
  if (console_.interrupted()) return cancelled_error();
  figures_.executor = solver.name();
  figures_.threads = options_.solver.kind == ExecutorKind::reference
                         ? 1
                         : static_cast<int>(options_.solver.threads.value_or(available_processors()));
  figures_.band = solver.band();
  figures_.time_step = solver.time_step();
  figures_.memory = solver.memory();
  auto phi = solver.snapshot();
  if (!phi) return pass_on(phi);
  phi_ = std::move(*phi);
  mask_ = phi_.mask();
  figures_.surface = measure(phi_);
  if (truth_) figures_.dice = dice(mask_, *truth_);
  return {};
}

Status Segmentation::write() {
  std::optional<Volume> field;
  const auto dense_field = [&]() -> const Volume& {
    if (!field) field = phi_.to_volume();
    return *field;
  };
  std::optional<Mesh> mesh;
  for (const std::string& file : options_.out) {
    if (console_.interrupted()) return cancelled_error();
    if (form_of(file) == FileForm::mesh && !mesh) {
      auto surface = extract_surface(dense_field());
      if (!surface) return pass_on(surface);
      mesh = std::move(*surface);
    }
    const auto write_one = [&](const std::filesystem::path& name) {
      return form_of(file) == FileForm::mesh ? write_mesh(*mesh, name) : write_mask_file(mask_, name);
    };
    if (Status staged = outputs_.stage(file, write_one); !staged) return staged;
  }
  if (!options_.out_phi.empty()) {
    const auto write_phi = [&](const std::filesystem::path& name) {
      return write_volume_file(dense_field(), name);
    };
    if (Status staged = outputs_.stage(options_.out_phi, write_phi); !staged) return staged;
  }
  if (!options_.picture.empty()) {
    const auto picture = draw_picture();
    if (!picture) return tl::unexpected<Error>(picture.error());
    const auto write_picture = [&](const std::filesystem::path& name) {
      return write_png_file(picture->width, picture->height, picture->pixels, name);
    };
    if (Status staged = outputs_.stage(options_.picture, write_picture); !staged) return staged;
  }
  if (!options_.stats.empty()) {
    const auto write_stats = [&](const std::filesystem::path& name) {
      return write_file(name, to_text(to_json(figures_)));
    };
    if (Status staged = outputs_.stage(options_.stats, write_stats); !staged) return staged;
  }
  return {};
}

// The slices go through the middle of what was found, and the camera looks at it.
Result<Picture> Segmentation::draw_picture() {
  auto renderer = Renderer::create(device_, source_, phi_.layout);
  if (!renderer) return pass_on(renderer);
  if (Status shown = (*renderer)->set_phi(phi_); !shown) return pass_on(shown);
  (*renderer)->set_parameters(options_.parameters());
  constexpr PictureSize kSize{1200, 800};
  SheetView view;
  view.position_mm = middle_of(mask_);
  view.window = window_of(*source_);
  view.speed = true;
  view.volume.camera.azimuth = 30.0;
  view.volume.camera.elevation = 20.0;
  view.volume.camera = view.volume.camera.on(box_around(phi_), source_->geometry, kSize.aspect() * 4.0 / 3.0);
  return draw_sheet(**renderer, view, kSize, console_.progress());
}

void Segmentation::say_warnings() {
  const std::int64_t inside = figures_.surface.voxels_inside;
  if (inside == 0) {
    console_.warn(
        "the surface has vanished: nothing is inside (is the target right? a larger range or alpha?)");
  } else if (inside == figures_.geometry.voxel_count()) {
    console_.warn("the surface has filled the whole volume (a smaller range or alpha?)");
  }
  if (options_.until_converged() && !figures_.advance.converged) {
    console_.warn(
        fmt::format("the surface was still moving after {} steps (--max-steps)", figures_.advance.steps));
  }
}

}  // namespace

void add_segment(CLI::App& app, Program& program) {
  auto options = std::make_shared<SegmentOptions>();
  CLI::App& command = add_command(app, program, {"segment", kSummary, kDescription, kExamples},
                                  [&program, options] { return Segmentation(program, *options).run(); });
  add_segment_options(command, *options);
}

}  // namespace tidemark::cli
