// A robot that segments real studies by painting strokes, as a user would, with the speed function
// `examples`. Prints how much of the truth it has after each round, how long a round takes, and what the best
// tent reaches.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <numeric>
#include <string>
#include <vector>

#include "best_tent.h"
#include "cases.h"
#include "core/stopwatch.h"
#include "core/thread_pool.h"
#include "robot.h"
#include "solver/distance_transform.h"
#include "solver/executor.h"
#include "solver/speed/cached_speed.h"
#include "solver/speed/examples/examples_speed.h"
#include "solver/speed/examples/forest_training.h"
#include "solver/speed/growing_region.h"

namespace tidemark {
namespace {

// Of small objects in many places: curvature takes away what is a few voxels wide, and strokes in one object
// must not speak against the next one.
constexpr double kAlphaOfMany = 0.9;
constexpr double kEdgesOfMany = 200.0;
// Until so many strokes, they are looked for anew after each round; then those that were found are corrected.
constexpr int kStrokesToFindMany = 9;

// Of one tent: to its rest.
constexpr std::int64_t kStepsOfTent = 2000;

struct Settings {
  std::string folder;
  std::string only;
  int strokes = 20;
  bool still = false;
  double alpha = 0.7;
  std::int64_t steps = 60;  // a leak is seen while it is small
  solver::ExamplesOptions options;
};

std::vector<double> whole(const solver::SpeedFunction& function, Index3 size) {
  std::vector<double> speed(static_cast<std::size_t>(size.x * size.y * size.z));
  ThreadPool threads;
  threads.for_each((size.z + 7) / 8, 1, [&](std::int64_t first, std::int64_t last, int) {
    for (std::int64_t n = first; n < last; ++n) {
      const solver::VoxelBox box{{0, 0, 8 * n}, {size.x, size.y, std::min<std::int64_t>(8, size.z - 8 * n)}};
      function.evaluate(box, speed.data() + 8 * n * size.x * size.y);
    }
  });
  return speed;
}

// Dice a round, and what of it counts.
struct Outcome {
  std::vector<double> dice;
  double tent = 0.0;              // Dice of the best one
  double training_seconds = 0.0;  // of the longest
  double round_seconds = 0.0;     // of the longest, with training

  // Below the best before, from round 4 on.
  [[nodiscard]] double worst_fall() const {
    double fall = 0.0;
    for (std::size_t round = 4; round < dice.size(); ++round) {
      fall = std::max(fall,
                      *std::max_element(dice.begin(), dice.begin() + static_cast<long>(round)) - dice[round]);
    }
    return fall;
  }
};

// What the strokes found so far.
class Surface {
 public:
  virtual ~Surface() = default;
  virtual Result<Mask> follow(std::shared_ptr<const solver::ExamplesSpeed> function, const Robot& robot) = 0;
};

class StillSurface final : public Surface {
 public:
  explicit StillSurface(const Geometry& grid) : grid_(grid) {}
  Result<Mask> follow(std::shared_ptr<const solver::ExamplesSpeed> function, const Robot& robot) override {
    return connected(grid_, whole(*function, grid_.size), robot.inside());
  }

 private:
  Geometry grid_;
};

// The level set of the processor. It goes on from where it is; strokes inside that it does not hold add
// spheres. Of objects in many places it first begins anew each time, wherever it would grow.
class LevelSetSurface final : public Surface {
 public:
  static Result<std::unique_ptr<Surface>> make(const RobotCase& robot_case, const Settings& settings) {
    solver::Parameters parameters;
    parameters.alpha = robot_case.many ? kAlphaOfMany : settings.alpha;
    auto executor = solver::make_executor(solver::ExecutorKind::host, robot_case.images.front(), parameters);
    if (!executor) return pass_on(executor);
    auto surface = std::make_unique<LevelSetSurface>();
    surface->executor_ = std::move(*executor);
    surface->steps_ = settings.steps;
    surface->many_ = robot_case.many;
    return surface;
  }

  Result<Mask> follow(std::shared_ptr<const solver::ExamplesSpeed> function, const Robot& robot) override {
    const Geometry& grid = function->features().geometry();
    TIDEMARK_TRY(executor_->set_speed(std::make_shared<solver::CachedSpeed>(function, grid.size)));
    if (many_ && robot.count() <= kStrokesToFindMany) {
      auto region = solver::growing_region(*function, grid, {});
      if (!region) return pass_on(region);
      const Inside inside = inside_of(std::make_shared<const BitMask>(std::move(*region)));
      TIDEMARK_TRY(executor_->restore(
          solver::distance_transform(inside, executor_->band(), executor_->memory().page_shape)));
    }
    const double unit = std::min({grid.spacing_mm.x, grid.spacing_mm.y, grid.spacing_mm.z});
    for (const Index3 centre : robot.inside()) {
      if (!found_.voxels.empty() && found_.voxels[static_cast<std::size_t>(grid.offset(centre))] != 0)
        continue;
      TIDEMARK_TRY(executor_->paint(solver::sphere_at_voxel(grid, glm::dvec3(centre), 4.0 * unit),
                                    solver::Brush::add));
    }
    const auto report = executor_->advance({.steps = steps_, .until_converged = true});
    if (!report) return pass_on(report);
    auto phi = executor_->snapshot();
    if (!phi) return pass_on(phi);
    found_ = phi->mask();
    return found_;
  }

 private:
  std::unique_ptr<solver::Executor> executor_;
  Mask found_;  // last
  std::int64_t steps_ = 0;
  bool many_ = false;
};

Result<Outcome> segment(const RobotCase& robot_case, const Settings& settings) {
  std::unique_ptr<Surface> surface = std::make_unique<StillSurface>(robot_case.truth.geometry);
  if (!settings.still) {
    auto made = LevelSetSurface::make(robot_case, settings);
    if (!made) return pass_on(made);
    surface = std::move(*made);
  }
  solver::ExamplesOptions options = settings.options;
  if (robot_case.many) options.walker.contrast = kEdgesOfMany;
  Robot robot(robot_case.truth);
  robot.begin();
  Outcome outcome;
  const auto tent = best_tent(robot_case.images.front(), robot_case.truth, robot.inside().front(),
                              settings.alpha, kStepsOfTent);
  if (!tent) return pass_on(tent);
  outcome.tent = *tent;
  // Kept until the next one is there, so that both share their images' pyramids.
  std::shared_ptr<const solver::ExamplesSpeed> function;
  for (;;) {
    Stopwatch watch;
    auto made = solver::ExamplesSpeed::train(robot_case.images, robot.strokes(), options, {});
    if (!made) return pass_on(made);
    function = std::move(*made);
    outcome.training_seconds = std::max(outcome.training_seconds, watch.seconds());
    auto found = surface->follow(function, robot);
    if (!found) return pass_on(found);
    outcome.round_seconds = std::max(outcome.round_seconds, watch.seconds());
    outcome.dice.push_back(dice(*found, robot_case.truth));
    if (robot.count() + 2 > settings.strokes) return outcome;
    robot.correct(*found);
  }
}

int run(const Settings& settings) {
  std::vector<double> all;
  std::vector<double> tents;
  double worst_fall = 0.0;
  for (const CaseFiles& files : robot_cases()) {
    if (!settings.only.empty() && files.name.find(settings.only) == std::string::npos) continue;
    auto loaded = load_case(settings.folder, files);
    if (!loaded) {
      fmt::print("{}: {}\n", files.name, loaded.error().message);
      return 1;
    }
    const auto outcome = segment(*loaded, settings);
    if (!outcome) {
      fmt::print("{}: {}\n", files.name, outcome.error().message);
      return 1;
    }
    fmt::print("{:<20}", files.name);
    for (const double share : outcome->dice) fmt::print(" {:.2f}", share);
    fmt::print("  tent {:.2f}  fall {:.2f}  training {:.2f} s, round {:.1f} s\n", outcome->tent,
               outcome->worst_fall(), outcome->training_seconds, outcome->round_seconds);
    std::fflush(stdout);
    all.push_back(outcome->dice.back());
    tents.push_back(outcome->tent);
    worst_fall = std::max(worst_fall, outcome->worst_fall());
  }
  std::sort(all.begin(), all.end());
  std::sort(tents.begin(), tents.end());
  if (!all.empty()) {
    const double mean = std::accumulate(all.begin(), all.end(), 0.0) / static_cast<double>(all.size());
    fmt::print("median {:.3f} (tents {:.3f}), least {:.3f}, mean {:.3f}, worst fall {:.2f}\n",
               all[all.size() / 2], tents[tents.size() / 2], all.front(), mean, worst_fall);
  }
  return 0;
}

}  // namespace
}  // namespace tidemark

int main(int argc, char** argv) {
  tidemark::Settings settings;
  CLI::App app("A robot that paints strokes on real studies");
  app.add_option("folder", settings.folder, "the studies")->required();
  app.add_option("--case", settings.only, "only cases whose names have this");
  app.add_option("--strokes", settings.strokes, "at most");
  app.add_flag("--still", settings.still, "no level set: the part of D > 0 that is connected to the strokes");
  app.add_option("--alpha", settings.alpha, "of the level set");
  app.add_option("--steps", settings.steps, "a round, at most");
  app.add_option("--trees", settings.options.training.trees, "how many decide");
  app.add_option("--depth", settings.options.training.depth, "of a tree, at most");
  app.add_option("--leaf", settings.options.training.smallest_leaf, "samples, at least");
  app.add_option("--features", settings.options.training.tried_features,
                 "tried a node; 0: the root of their number");
  app.add_option("--thresholds", settings.options.training.tried_thresholds, "tried a feature");
  app.add_option("--doubt", settings.options.training.doubt,
                 "samples of either class that each leaf is given beforehand");
  app.add_option("--seed", settings.options.training.seed, "of the forest");
  app.add_option("--sharpness", settings.options.sharpness, "of D");
  app.add_option("--contrast", settings.options.walker.contrast, "how much an edge holds walks back");
  app.add_option("--prior", settings.options.walker.prior, "how often a walk ends and the forest decides");
  app.add_option("--caution", settings.options.walker.caution, "how much doubt counts as outside");
  app.add_option("--sweeps", settings.options.walker.sweeps, "over each grid of the walker");
  app.add_option("--cells", settings.options.walker.most_cells, "of the walker, at most");
  CLI11_PARSE(app, argc, argv);
  return tidemark::run(settings);
}
