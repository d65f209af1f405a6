#include "app/cli/segment_options.h"

#include "document/file_limits.h"
#include "imaging/filters/filters.h"

namespace tidemark::cli {
namespace {

void add_equation_options(CLI::App& app, SegmentOptions& options) {
  const char* const kGroup = "Equation";
  const auto number = [&](const char* name, std::optional<double>& value, const char* description) {
    add_number(app, name, value, description)->group(kGroup);
  };
  number("--target", options.target,
         "T, of the tent: the brightness that attracts the surface, in the volume's units (HU for CT)");
  number("--range", options.range,
         "epsilon, of the tent: the surface grows where brightness is within T -+ epsilon, in the same\n"
         "units; > 0");
  number("--alpha", options.alpha, "0 (smoothing alone) to 1 (brightness alone)");
  number("--smooth", options.smooth_mm, "Smooth the volume first: the Gaussian's standard deviation in mm");
  number("--rescale", options.rescale, "w: weight of the term that keeps phi a distance (default: 0.75 / W)");
  number("--band", options.band,
         "W: half-width of the computed band in smallest voxel spacings, >= 2\n(default: the larger of 2.5 "
         "and twice the "
         "largest spacing by the smallest)");
  add_choice<solver::Scheme>(
      app, "--scheme", options.scheme, {{"split", solver::Scheme::split}, {"paper", solver::Scheme::paper}},
      "split (default): each speed term has its own gradient; paper: one for their sum");
  add_choice<solver::DataForm>(
      app, "--data", options.data_form,
      {{"clamped", solver::DataForm::clamped}, {"raw", solver::DataForm::raw}},
      "clamped (default): the data term is max(-1, 1 - |I-T|/epsilon); raw: epsilon - |I-T|");
  app.add_flag("--no-data", options.no_data, "Without the data term");
  app.add_flag("--no-curvature", options.no_curvature, "Without the curvature term");
  app.add_flag("--no-rescaling", options.no_rescaling, "Without the rescaling term");
}

void add_run_options(CLI::App& app, SegmentOptions& options) {
  add_count(app, "--steps", options.steps, "Compute exactly N steps (0: just the start)");
  app.add_flag("--converge", options.converge, "Compute until the surface has stopped moving (default)");
  add_count(app, "--max-steps", options.max_steps,
            fmt::format("With --converge: stop after N steps at the latest (default: {})",
                        solver::kMostStepsToRest));
}

void add_comparison_options(CLI::App& app, SegmentOptions& options) {
  const char* const kGroup = "Results";
  app.add_option("--truth", options.truth,
                 "A mask to compare with: the figures say how well results agree with it")
      ->type_name("MASK")
      ->group(kGroup);
  add_count(app, "--truth-label", options.truth_label,
            "Compare with the voxels of --truth that hold N (default: all that are not 0)")
      ->group(kGroup);
}

Status check_present(const SegmentOptions& options) {
  if (options.auto_start) return {};
  const bool tent = options.drive.uses_tent();
  for (const auto& [name, value, needed] :
       {std::tuple{"--target", options.target, tent}, std::tuple{"--range", options.range, tent},
        std::tuple{"--alpha", options.alpha, true}}) {
    if (needed && !value) return fail(ErrorKind::usage, "{} is needed (or --auto-start)", name);
  }
  if (!options.start.given()) {
    return fail(ErrorKind::usage,
                "a start is needed: --seed, --seed-mm, --init, --init-threshold, --init-flood, "
                "--init-speed or --init-phi (or --auto-start)");
  }
  return {};
}

Status check_numbers(const SegmentOptions& options) {
  if (options.smooth_mm && *options.smooth_mm <= 0.0) {
    return fail(ErrorKind::usage, "--smooth {}: must be greater than 0 mm", *options.smooth_mm);
  }
  if (options.smooth_mm && *options.smooth_mm > imaging::kMostSmoothing_mm) {
    return fail(ErrorKind::usage, "--smooth {}: must be at most {} mm", *options.smooth_mm,
                imaging::kMostSmoothing_mm);
  }
  if (options.steps && (options.converge || options.max_steps)) {
    return fail(ErrorKind::usage, "--steps excludes --converge and --max-steps");
  }
  if (options.step_limit() > document::kMostSteps)
    return fail(ErrorKind::usage, "more than {} steps", document::kMostSteps);
  if (options.max_steps && *options.max_steps < 1)
    return fail(ErrorKind::usage, "--max-steps: must be at least 1");
  if (options.truth_label && !options.truth) return fail(ErrorKind::usage, "--truth-label needs --truth");
  // The values of --auto-start are within the limits; the others are checked now.
  SegmentOptions filled = options;
  if (options.auto_start || !options.drive.uses_tent()) {
    filled.target = options.target.value_or(0.0);
    filled.range = options.range.value_or(1.0);
    filled.alpha = options.alpha.value_or(0.5);
  }
  return check(filled.parameters());
}

// All but the executor and the results.
void add_common_options(CLI::App& app, SegmentOptions& options) {
  add_study_input(app, options.study);
  app.add_flag("--auto-start", options.auto_start,
               "Choose what is not given of seed, target, range and alpha from the volume itself:\nan even, "
               "bright region "
               "near the middle; says what it chose");
  add_equation_options(app, options);
  add_drive_options(app, options.drive);
  add_within_option(app, options.drive);
  add_start_options(app, options.start);
  add_run_options(app, options);
  add_comparison_options(app, options);
}

}  // namespace

std::int64_t SegmentOptions::step_limit() const {
  return steps.value_or(max_steps.value_or(solver::kMostStepsToRest));
}

solver::Parameters SegmentOptions::parameters() const {
  solver::Parameters parameters;
  parameters.target = target.value_or(parameters.target);
  parameters.range = range.value_or(parameters.range);
  parameters.alpha = *alpha;
  parameters.band = band;
  parameters.rescale = rescale;
  parameters.scheme = scheme;
  parameters.data_form = data_form;
  parameters.data_term = !no_data;
  parameters.curvature_term = !no_curvature;
  parameters.rescaling_term = !no_rescaling;
  return parameters;
}

void add_segment_options(CLI::App& app, SegmentOptions& options) {
  add_common_options(app, options);
  add_levels_option(app, options.start);
  add_solver_options(app, options.solver);
  add_result_options(app, options.results);
}

void add_sweep_options(CLI::App& app, SegmentOptions& options) {
  add_common_options(app, options);
  add_host_options(app, options.solver);
}

Status check(const SegmentOptions& options) {
  TIDEMARK_TRY(check_present(options));
  TIDEMARK_TRY(check_numbers(options));
  TIDEMARK_TRY(check(options.start));
  TIDEMARK_TRY(check(options.drive, options.start.mask.has_value()));
  TIDEMARK_TRY(check_tent(options.drive, options.target.has_value(), options.range.has_value()));
  return check(options.solver);
}

std::vector<std::string> inputs_of(const SegmentOptions& options) {
  std::vector<std::string> inputs = inputs_of(options.drive);
  for (const auto& input : {options.start.mask, options.start.phi, options.truth}) {
    if (input) inputs.push_back(*input);
  }
  return inputs;
}

}  // namespace tidemark::cli
