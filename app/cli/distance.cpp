// tidemark-cli distance: from a mask to the signed distance to its boundary.
#include <algorithm>
#include <memory>

#include "app/cli/outputs.h"
#include "app/cli/program.h"
#include "app/cli/report.h"
#include "app/cli/solver_options.h"
#include "app/cli/study_input.h"
#include "imaging/files/volume_file.h"
#include "imaging/results/results.h"
#include "solver/distance_transform.h"

namespace tidemark::cli {
namespace {

constexpr CommandHelp kDistance{
    "distance", "Turns a mask into the signed distance to its surface",
    "Turns MASK (every voxel that is not 0) into the signed distance to its surface: in mm, > 0 inside,\n"
    "clamped at the band's half-width. Computed by the level set's rescaling term alone, without brightness "
    "or\n"
    "curvature, from the exact distance to the mask's voxel faces, until nothing moves (500 steps at most).",
    "  tidemark-cli distance mask.nii.gz --out distance.nii.gz\n"
    "  tidemark-cli distance mask.nii.gz --band 10 --out distance.nrrd     10 smallest voxel spacings "
    "wide\n"};

constexpr std::int64_t kStepsAtMost = 500;

struct DistanceOptions {
  std::string mask;
  std::vector<std::string> out;
  std::optional<double> band;
  SolverOptions solver;
};

// The equation with nothing but its rescaling term.
solver::Parameters rescaling_alone(const std::optional<double>& band) {
  solver::Parameters parameters;
  parameters.alpha = 1.0;
  parameters.band = band;
  parameters.data_term = false;
  parameters.curvature_term = false;
  return parameters;
}

// A volume of zeros: the data term, which would read it, is off.
std::shared_ptr<const Volume> empty_source(const Geometry& geometry) {
  auto source = std::make_shared<Volume>();
  source->geometry = geometry;
  source->voxels = std::vector<std::int16_t>(static_cast<std::size_t>(geometry.voxel_count()), 0);
  return source;
}

double smallest_spacing(const Geometry& geometry) {
  return std::min({geometry.spacing_mm.x, geometry.spacing_mm.y, geometry.spacing_mm.z});
}

Status check(const DistanceOptions& options, Outputs& outputs, const Progress& progress) {
  TIDEMARK_TRY(check(rescaling_alone(options.band)));
  TIDEMARK_TRY(check(options.solver));
  for (const std::string& file : options.out) {
    TIDEMARK_TRY(outputs.announce("--out", file, {FileForm::volume}));
  }
  return spare_inputs(outputs, {options.mask}, progress);
}

Json to_json(const solver::Executor& solver, const solver::AdvanceReport& report, const Geometry& geometry) {
  Json object;
  object["executor"] = solver.name();
  object["steps"] = report.steps;
  object["seconds"] = report.seconds;
  object["converged"] = report.converged;
  object["band"] = solver.band();
  object["band_mm"] = solver.band() * smallest_spacing(geometry);
  object.update(grid_json(geometry));
  return object;
}

// phi in units of the smallest spacing becomes mm.
Volume in_millimetres(const solver::Field& phi) {
  Volume volume = phi.to_volume();
  const auto scale = static_cast<float>(smallest_spacing(phi.geometry));
  for (float& value : std::get<std::vector<float>>(volume.voxels)) value *= scale;
  return volume;
}

Status run(Program& program, const DistanceOptions& options) {
  Console& console = program.console;
  Outputs outputs;
  TIDEMARK_TRY(check(options, outputs, console.progress()));
  const auto loaded = imaging::load_any_mask(options.mask, nullptr, console.progress());
  if (!loaded) return pass_on(loaded);
  const Mask& mask = loaded->mask;
  if (console.interrupted()) return cancelled_error();
  auto executor = solver::make_executor(options.solver.kind.value_or(solver::ExecutorKind::automatic),
                                        empty_source(mask.geometry), rescaling_alone(options.band),
                                        options.solver.executor_options());
  if (!executor) return pass_on(executor);
  solver::Executor& solver = **executor;
  TIDEMARK_TRY(solver.restore(solver::distance_transform(mask, solver.band())));
  const auto report = solver.advance(solver::Advance{kStepsAtMost, true, console.progress()});
  if (!report) return pass_on(report);
  if (console.interrupted()) return cancelled_error();

  auto phi = solver.snapshot();
  if (!phi) return pass_on(phi);
  const Volume distance = in_millimetres(*phi);
  for (const std::string& file : options.out) {
    const auto write = [&](const std::filesystem::path& name) {
      return imaging::write_volume_file(distance, name);
    };
    TIDEMARK_TRY(outputs.stage(file, write));
    if (console.interrupted()) return cancelled_error();
  }
  TIDEMARK_TRY(outputs.commit(console.progress()));
  console.say("Steps      {}{}", report->steps, report->converged ? ", converged" : ", not converged");
  console.say("Distance   -{0:.4g} to {0:.4g} mm, > 0 inside",
              solver.band() * smallest_spacing(mask.geometry));
  for (const std::string& file : options.out) console.say("Wrote      {}", file);
  console.result(to_json(solver, *report, mask.geometry));
  return {};
}

}  // namespace

void add_distance(CLI::App& app, Program& program) {
  auto options = std::make_shared<DistanceOptions>();
  CLI::App& command =
      add_command(app, program, kDistance, [&program, options] { return run(program, *options); });
  command.add_option("MASK", options->mask, "A mask: every voxel that is not 0 is inside")
      ->required()
      ->type_name("");
  command
      .add_option("--out", options->out,
                  ".nii .nii.gz .nrrd .mha: the distance in mm, float; may be repeated")
      ->required()
      ->allow_extra_args(false)
      ->type_name("FILE");
  add_number(command, "--band", options->band,
             "Half-width of the band in smallest voxel spacings, >= 2\n(default: the larger of 2.5 and twice "
             "the largest "
             "spacing by the smallest)");
  add_solver_options(command, options->solver);
}

}  // namespace tidemark::cli
