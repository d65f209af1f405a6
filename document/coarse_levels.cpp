#include "document/coarse_levels.h"

#include "core/large_pages.h"
#include "solver/coarse_grid.h"
#include "solver/speed/coarse_speed.h"

namespace tidemark::document {
namespace {

// Executors take their grid from a volume; here they read nothing else of it.
std::shared_ptr<const Volume> grid_alone(const Geometry& geometry) {
  auto volume = std::make_shared<Volume>();
  volume->geometry = geometry;
  volume->voxels = make_large_vector<std::int16_t>(static_cast<std::size_t>(geometry.voxel_count()));
  return volume;
}

class CoarseLevels {
 public:
  CoarseLevels(const Start& start, const CoarseInputs& inputs, const Progress& progress)
      : start_(start), inputs_(inputs), progress_(progress) {}

  Result<std::optional<CoarseStart>> run();

 private:
  [[nodiscard]] Status check_fits() const;
  Status find_inside();
  Result<std::unique_ptr<solver::Executor>> make_executor(const solver::CoarseGrid& grid) const;
  Result<bool> begin(solver::Executor& executor, const solver::CoarseGrid& grid);
  Status come_to_rest(solver::Executor& executor, const solver::CoarseGrid& grid, int level);

  const Start& start_;
  const CoarseInputs& inputs_;
  const Progress& progress_;
  std::optional<Inside> inside_;  // by the start's first part, on the volume's grid
  CoarseStart result_;
};

Result<std::optional<CoarseStart>> CoarseLevels::run() {
  TIDEMARK_TRY(check_fits());
  TIDEMARK_TRY(find_inside());
  for (int halvings = start_.levels - 1; halvings > 0; --halvings) {
    const solver::CoarseGrid grid(inputs_.source.geometry, halvings);
    auto executor = make_executor(grid);
    if (!executor) return pass_on(executor);
    const auto begun = begin(**executor, grid);
    if (!begun) return pass_on(begun);
    if (!*begun) return std::nullopt;
    TIDEMARK_TRY(come_to_rest(**executor, grid, start_.levels - 1 - halvings));
    if (!result_.phi.has_inside()) return std::nullopt;
  }
  const solver::CoarseGrid last(inputs_.source.geometry, 1);
  result_.phi = solver::refined(result_.phi, last, inputs_.band, inputs_.page_shape, inputs_.options.threads);
  // A block that is barely inside has no voxel that is.
  if (!result_.phi.has_inside()) return std::nullopt;
  return std::move(result_);
}

Status CoarseLevels::check_fits() const {
  if (std::holds_alternative<FieldStart>(start_.from)) {
    return fail(ErrorKind::usage, "a saved level set goes on as it is: it has no coarser levels");
  }
  // Its mean over a block is no tent, and executors on a GPU keep any other D within [-1, 1].
  if (const solver::Tent* tent = inputs_.speed->tent(); tent != nullptr && tent->is_raw()) {
    return fail(ErrorKind::usage, "the raw form of the tent has no coarser levels");
  }
  return check_spheres(start_, inputs_.source.geometry);
}

Status CoarseLevels::find_inside() {
  auto inside = inside_of(start_, {inputs_.source, inputs_.speed.get()}, progress_);
  if (!inside) return pass_on(inside);
  inside_ = std::move(*inside);
  return {};
}

Result<std::unique_ptr<solver::Executor>> CoarseLevels::make_executor(const solver::CoarseGrid& grid) const {
  auto executor = solver::make_executor(inputs_.kind, grid_alone(grid.coarse()),
                                        solver::coarsened(inputs_.parameters, grid), inputs_.options);
  if (!executor) return executor;
  TIDEMARK_TRY((*executor)->set_speed(std::make_shared<const solver::CoarseSpeed>(
      inputs_.speed, grid, solver::velocity_factor(inputs_.parameters, grid))));
  if (inputs_.marks != nullptr) {
    TIDEMARK_TRY((*executor)->set_constraints(
        std::make_shared<const solver::Constraints>(solver::coarsened(*inputs_.marks, grid))));
  }
  return executor;
}

// Whether there is a surface on the grid: the start's on the coarsest, else that of the level before.
Result<bool> CoarseLevels::begin(solver::Executor& executor, const solver::CoarseGrid& grid) {
  if (!result_.runs.empty()) {
    const solver::CoarseGrid next(grid.coarse(), 1);
    TIDEMARK_TRY(executor.restore(solver::refined(result_.phi, next, executor.band(),
                                                  executor.memory().page_shape, inputs_.options.threads)));
    return true;
  }
  Start coarse;
  coarse.seeds = start_.seeds;
  coarse.erasers = start_.erasers;
  if (inside_) {
    coarse.from = MaskStart{std::make_shared<const BitMask>(solver::coarsened(*inside_, grid)), {}};
    inside_.reset();
  }
  Volume volume;
  volume.geometry = grid.coarse();
  auto phi = place(executor, {volume}, coarse, progress_);
  if (!phi) return pass_on(phi);
  return phi->has_inside();
}

Status CoarseLevels::come_to_rest(solver::Executor& executor, const solver::CoarseGrid& grid, int level) {
  auto advance = executor.advance({kMostCoarseSteps, true, progress_.part(level, start_.levels - 1)});
  if (!advance) return pass_on(advance);
  if (progress_.cancelled()) return cancelled_error();
  auto phi = executor.snapshot();
  if (!phi) return pass_on(phi);
  result_.phi = std::move(*phi);
  result_.runs.push_back({grid.coarse().size, *advance});
  return {};
}

}  // namespace

Result<std::optional<CoarseStart>> run_coarse_levels(const Start& start, const CoarseInputs& inputs,
                                                     const Progress& progress) {
  return CoarseLevels(start, inputs, progress).run();
}

}  // namespace tidemark::document
