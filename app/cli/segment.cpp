// tidemark-cli segment: from a volume and a start to mask, surface and figures.
#include <memory>

#include "app/cli/program.h"
#include "app/cli/run_inputs.h"
#include "app/cli/segment_options.h"
#include "solver/distance_transform.h"
#include "solver/inside_region.h"
#include "solver/surface_agreement.h"

namespace tidemark::cli {
namespace {

constexpr double kTruthBand = 2.0;  // nothing but where the surface lies is taken from it
constexpr CommandHelp kSegment{
    "segment", "Grows a surface from a start and writes mask, surface and figures",
    "Segments INPUT: a surface starts at seeds or a mask, grows where brightness is within target -+ range\n"
    "(the volume's units, HU for CT), and is smoothed by its curvature. Voxel indices I,J,K are 0-based;\n"
    "radii, patient coordinates X,Y,Z (LPS) and smoothing are in mm. An interrupted run writes nothing.",
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
    "  tidemark-cli segment ct/ --target 100 --range 40 --alpha 0.5 --seed-mm=-60,20,110,8 --out seg.dcm "
    "\\\n"
    "      --rtstruct contours.dcm --label Liver,liver\n"
    "  tidemark-cli segment unknown/ --auto-start --out first-look.stl\n"};

// One run of the command.
class Segmentation {
 public:
  Segmentation(Program& program, SegmentOptions options)
      : console_(program.console), options_(std::move(options)), writer_(options_.results, console_) {}

  Status run();

 private:
  Status evolve();
  Status compare_with_truth();
  void say_warnings();

  Console& console_;
  SegmentOptions options_;
  ResultWriter writer_;
  std::optional<BitMask> truth_;  // of --truth
  RunResults results_;
};

Status Segmentation::run() {
  TIDEMARK_TRY(check(options_));
  TIDEMARK_TRY(writer_.prepare());
  TIDEMARK_TRY(writer_.spare(options_.study, inputs_of(options_)));
  auto truth = read_inputs(options_, writer_.wants_recipe(), console_, results_);
  if (!truth) return pass_on(truth);
  truth_ = std::move(*truth);
  TIDEMARK_TRY(evolve());
  TIDEMARK_TRY(writer_.write(results_));
  say_warnings();
  console_.result(to_json(results_.figures));
  return {};
}

Status Segmentation::evolve() {
  RunFigures& figures = results_.figures;
  document::Recipe& recipe = results_.recipe;
  if (recipe.drive != nullptr) console_.say("Speed      {}", describe(*recipe.drive));
  console_.say("Start      {}", recipe.start.describe());
  const auto kind = options_.solver.kind.value_or(solver::ExecutorKind::automatic);
  auto evolution = document::evolve(recipe, results_.source,
                                    {kind, options_.solver.executor_options(), options_.until_converged()},
                                    console_.progress());
  if (!evolution) return pass_on(evolution);
  if (console_.interrupted()) return cancelled_error();
  results_.take(std::move(*evolution));
  recipe.smoothed_mm = options_.smooth_mm.value_or(0.0);  // by load(): evolve() smooths nothing
  figures.threads = threads_of(options_.solver, figures.executor);
  if (const auto* mask = std::get_if<document::MaskStart>(&recipe.start.from)) {
    figures.change =
        change_between(Region(*mask->mask), solver::inside_region(results_.phi), results_.phi.geometry);
  }
  return compare_with_truth();
}

Status Segmentation::compare_with_truth() {
  if (!truth_) return {};
  RunFigures& figures = results_.figures;
  figures.dice = dice(solver::inside_region(results_.phi), Region(*truth_));
  const solver::Field truth = solver::distance_transform(inside_of(*truth_), kTruthBand);
  auto agreement = solver::agreement(results_.phi, truth, console_.progress());
  if (!agreement) return pass_on(agreement);
  figures.truth_distance = agreement->distance;
  return {};
}

void Segmentation::say_warnings() {
  const RunFigures& figures = results_.figures;
  if (const std::string advice = advice_on(figures); !advice.empty()) console_.warn(advice);
  if (results_.recipe.start.levels > 1 && figures.coarse_runs.empty()) {
    console_.warn("too small for coarser levels: the surface began on the volume's own grid");
  }
  if (options_.until_converged() && !figures.advance.converged) {
    std::string where;
    if (const auto& place = figures.moves_at) {
      where = fmt::format(", at voxel {:.0f},{:.0f},{:.0f} for one", place->x, place->y, place->z);
    }
    console_.warn(fmt::format("the surface was still moving after {} steps (--max-steps){}",
                              figures.advance.steps, where));
  }
}

}  // namespace

void add_segment(CLI::App& app, Program& program) {
  auto options = std::make_shared<SegmentOptions>();
  CLI::App& command = add_command(app, program, kSegment,
                                  [&program, options] { return Segmentation(program, *options).run(); });
  add_segment_options(command, *options);
}

}  // namespace tidemark::cli
