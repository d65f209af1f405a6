#include "app/cli/results.h"

#include <algorithm>
#include <optional>

#include "core/json/json_text.h"
#include "core/large_pages.h"
#include "document/segment_meshes.h"
#include "imaging/files/png_file.h"
#include "imaging/files/volume_file.h"
#include "imaging/results/results.h"
#include "imaging/surface/surface.h"
#include "renderer/sheet.h"
#include "solver/inside_region.h"
#include "solver/speed/tent_speed.h"

namespace tidemark::cli {

void add_result_options(CLI::App& app, ResultOptions& options) {
  const char* const kGroup = "Results";
  app.add_option(
         "--out", options.out,
         ".nii .nii.gz .nrrd .mha: the mask (1 inside);\n.dcm: the mask as DICOM segmentation (SEG) of the "
         "study;\n.stl .ply .obj: the surface in patient mm (LPS);\n.json: the recipe; may be repeated")
      ->allow_extra_args(false)
      ->type_name("FILE")
      ->group(kGroup);
  app.add_option(
         "--out-phi", options.out_phi,
         "The level set itself, to go on from with --init-phi (.nii .nii.gz .nrrd .mha, float):\n> 0 "
         "inside, in units of the smallest voxel spacing;\nor for others as OpenVDB (.vdb): < 0 inside, in "
         "patient mm (LPS)")
      ->type_name("FILE")
      ->group(kGroup);
  app.add_option("--out-speed", options.out_speed,
                 "The speed D of every voxel at the end, -1 to 1 (.nii .nii.gz .nrrd .mha, float)")
      ->type_name("FILE")
      ->group(kGroup);
  app.add_option("--rtstruct", options.rtstruct,
                 "The surface's contours in each slice as RT structure set of the study")
      ->type_name("FILE.dcm")
      ->group(kGroup);
  add_label(app, options.label)->group(kGroup);
  app.add_option("--picture", options.picture, "Three slices and the surface in 3D, .png")
      ->type_name("FILE.png")
      ->group(kGroup);
  add_renderer_option(app, options.renderer)->group(kGroup);
  app.add_option("--stats", options.stats, "Figures of the run as JSON (ml, mm^2, voxels, steps/s, bytes)")
      ->type_name("FILE.json")
      ->group(kGroup);
  app.add_option("--recipe", options.recipe,
                 "Start, parameters and number of steps as JSON: replay makes the same voxels of it")
      ->type_name("FILE.json")
      ->group(kGroup);
}

void RunResults::take(document::Evolution evolution) {
  figures.executor = evolution.executor.name;
  figures.start = recipe.start.describe();
  figures.parameters = recipe.final_parameters();
  figures.drive = recipe.final_drive();
  figures.band = evolution.band;
  figures.time_step = evolution.time_step;
  figures.coarse_runs = std::move(evolution.coarse_runs);
  figures.advance = evolution.advance;
  figures.memory = evolution.memory;
  figures.surface = evolution.surface;
  figures.outcome = evolution.outcome;
  figures.wider_range = evolution.wider_range;
  figures.moves_at = evolution.moves_at;
  recipe.executor = std::move(evolution.executor);
  recipe.steps = evolution.advance.steps;
  source = std::move(evolution.source);
  speed = std::move(evolution.speed);
  phi = std::move(evolution.phi);
}

Status ResultWriter::prepare() {
  for (const std::string& file : options_.out) {
    Status good = outputs_.announce(
        "--out", file, {FileForm::volume, FileForm::segmentation, FileForm::mesh, FileForm::recipe});
    if (!good) return good;
  }
  if (!options_.out_phi.empty()) {
    Status good = outputs_.announce("--out-phi", options_.out_phi, {FileForm::volume, FileForm::level_set});
    if (!good) return good;
  }
  if (!options_.out_speed.empty()) {
    TIDEMARK_TRY(outputs_.announce("--out-speed", options_.out_speed, {FileForm::volume}));
  }
  if (!options_.rtstruct.empty()) {
    TIDEMARK_TRY(outputs_.announce_dicom("--rtstruct", options_.rtstruct));
  }
  for (const auto& [option, file] : {std::pair{"--stats", options_.stats}, {"--recipe", options_.recipe}}) {
    if (file.empty()) continue;
    TIDEMARK_TRY(outputs_.announce_json(option, file));
  }
  if (options_.picture.empty()) return {};
  TIDEMARK_TRY(outputs_.announce_png("--picture", options_.picture));
  auto renderer = choose_renderer(options_.renderer);
  if (!renderer) return pass_on(renderer);
  renderer_ = std::move(*renderer);
  return {};
}

Status ResultWriter::spare(const StudyInput& study, const std::vector<std::string>& inputs,
                           const imaging::GridPolicy& otherwise) const {
  TIDEMARK_TRY(spare_study(outputs_, study, console_.progress(), otherwise));
  return spare_inputs(outputs_, inputs, console_.progress());
}

bool ResultWriter::wants_recipe() const {
  return !options_.recipe.empty() ||
         std::any_of(options_.out.begin(), options_.out.end(),
                     [](const std::string& file) { return form_of(file) == FileForm::recipe; });
}

Status ResultWriter::stage_text(const std::string& file, const std::string& text) {
  return outputs_.stage(file, [&](const std::filesystem::path& name) { return write_file(name, text); });
}

Status ResultWriter::stage_dicom(const std::string& file, imaging::ResultForm form,
                                 const RunResults& results) {
  imaging::Segments segments =
      imaging::segments_of(solver::inside_region(results.phi), results.phi.geometry, "Segment");
  segments.list.front().phi = std::make_shared<const Volume>(results.phi.to_volume());
  options_.label.apply(segments.list.front());
  return outputs_.stage(file, [&](const std::filesystem::path& name) {
    return form == imaging::ResultForm::segmentation
               ? imaging::write_segmentation(segments, results.dicom_files, name, console_.progress())
               : imaging::write_structure_set(segments, results.dicom_files, name, console_.progress());
  });
}

Status ResultWriter::stage_phi(const RunResults& results) {
  const Volume phi = results.phi.to_volume();
  return outputs_.stage(options_.out_phi, [&](const std::filesystem::path& name) {
    return form_of(options_.out_phi) == FileForm::level_set
               ? imaging::write_level_set(phi, results.phi.band, name)
               : imaging::write_volume_file(phi, name);
  });
}

Status ResultWriter::stage_speed(const RunResults& results) {
  std::shared_ptr<const solver::SpeedFunction> speed = results.speed;
  if (speed == nullptr)
    speed = std::make_shared<solver::TentSpeed>(results.source, results.figures.parameters);
  const Geometry& grid = results.source->geometry;
  auto values = make_large_vector<float>(static_cast<std::size_t>(grid.voxel_count()));
  auto next = values.begin();
  constexpr std::int64_t kSlices = 16;  // at a time, so that doubles are few
  std::vector<double> some(static_cast<std::size_t>(kSlices * grid.size.x * grid.size.y));
  for (std::int64_t k = 0; k < grid.size.z; k += kSlices) {
    if (console_.interrupted()) return cancelled_error();
    const solver::VoxelBox box{{0, 0, k}, {grid.size.x, grid.size.y, std::min(kSlices, grid.size.z - k)}};
    speed->evaluate(box, some.data());
    next = std::copy_n(some.begin(), box.voxels(), next);
  }
  Volume volume;
  volume.geometry = grid;
  volume.voxels = std::move(values);
  return outputs_.stage(options_.out_speed, [&](const std::filesystem::path& name) {
    return imaging::write_volume_file(volume, name);
  });
}

Status ResultWriter::stage_out(const RunResults& results) {
  std::optional<imaging::Mesh> mesh;
  for (const std::string& file : options_.out) {
    if (console_.interrupted()) return cancelled_error();
    const FileForm form = form_of(file);
    if (form == FileForm::recipe) {
      const auto text = results.recipe.to_text();
      if (!text) return pass_on(text);
      TIDEMARK_TRY(stage_text(file, *text));
      continue;
    }
    if (form == FileForm::segmentation) {
      TIDEMARK_TRY(stage_dicom(file, imaging::ResultForm::segmentation, results));
      continue;
    }
    if (form == FileForm::mesh && !mesh) {
      auto surface = document::mesh_of(results.phi);
      if (!surface) return pass_on(surface);
      mesh = std::move(*surface);
    }
    const auto write_one = [&](const std::filesystem::path& name) {
      return form == FileForm::mesh ? imaging::write_mesh(*mesh, name)
                                    : imaging::write_mask_file(results.phi.mask(), name);
    };
    TIDEMARK_TRY(outputs_.stage(file, write_one));
  }
  return {};
}

Status ResultWriter::stage(RunResults& results) {
  if (!options_.out_speed.empty()) {
    TIDEMARK_TRY(stage_speed(results));
  }
  if (!options_.picture.empty()) {
    const auto picture = draw(results);
    if (!picture) return pass_on(picture);
    const auto write_picture = [&](const std::filesystem::path& name) {
      return imaging::write_png_file(picture->width, picture->height, picture->pixels, name);
    };
    TIDEMARK_TRY(outputs_.stage(options_.picture, write_picture));
  }
  results.speed = nullptr;
  results.source = nullptr;
  TIDEMARK_TRY(stage_out(results));
  if (!options_.out_phi.empty()) {
    TIDEMARK_TRY(stage_phi(results));
  }
  if (!options_.rtstruct.empty()) {
    TIDEMARK_TRY(stage_dicom(options_.rtstruct, imaging::ResultForm::structure_set, results));
  }
  if (!options_.stats.empty()) {
    Status staged = stage_text(options_.stats, json_text(to_json(results.figures)));
    if (!staged) return staged;
  }
  if (options_.recipe.empty()) return {};
  const auto text = results.recipe.to_text();
  if (!text) return pass_on(text);
  return stage_text(options_.recipe, *text);
}

// The slices go through the middle of the segmented region, and the camera looks at it. As many threads draw
// as have computed.
Result<renderer::Picture> ResultWriter::draw(const RunResults& results) {
  auto renderer = renderer::make_renderer(renderer_.kind, renderer_.device, results.source,
                                          results.phi.layout, results.figures.threads);
  if (!renderer) return pass_on(renderer);
  TIDEMARK_TRY((*renderer)->set_phi(results.phi));
  (*renderer)->set_parameters(results.figures.parameters);
  (*renderer)->set_speed(results.speed);
  constexpr renderer::PictureSize kSize{1200, 800};
  renderer::SheetView view;
  view.position_mm = renderer::middle_of(results.phi);
  view.window = renderer::window_of(*results.source);
  view.sides_are_known = results.source->geometry.oriented;
  view.speed = true;
  view.volume.camera.azimuth = 30.0;
  view.volume.camera.elevation = 20.0;
  view.volume.camera = view.volume.camera.on(renderer::box_around(results.phi), results.source->geometry,
                                             kSize.aspect() * 4.0 / 3.0);
  return renderer::draw_sheet(**renderer, view, kSize, console_.progress());
}

Status ResultWriter::write(RunResults& results) {
  TIDEMARK_TRY(stage(results));
  TIDEMARK_TRY(outputs_.commit(console_.progress()));
  say(console_, results.figures);
  for (const std::string& file : options_.out) console_.say("Wrote      {}", file);
  for (const std::string& file : {options_.out_phi, options_.out_speed, options_.rtstruct, options_.picture,
                                  options_.stats, options_.recipe}) {
    if (!file.empty()) console_.say("Wrote      {}", file);
  }
  const bool any_dicom = !options_.rtstruct.empty() ||
                         std::any_of(options_.out.begin(), options_.out.end(), [](const std::string& file) {
                           return form_of(file) == FileForm::segmentation;
                         });
  if (any_dicom && results.dicom_files.empty()) console_.say("           {}", kAnonymousStudy);
  return {};
}

}  // namespace tidemark::cli
