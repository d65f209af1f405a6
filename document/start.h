// The start of a level set as data: what a recipe records and a user can do again.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/bit_mask.h"
#include "core/inside.h"
#include "core/progress.h"
#include "solver/executor.h"

namespace tidemark::solver {
class MotionLimit;
}

namespace tidemark::document {

// Voxels with low <= value <= high, in the source's units.
struct ThresholdStart {
  double low = 0.0;
  double high = 0.0;
  bool operator==(const ThresholdStart&) const = default;
};

// Those of them that are connected to `voxel` across faces.
struct FloodStart {
  Index3 voxel{0};
  double low = 0.0;
  double high = 0.0;
  bool operator==(const FloodStart&) const = default;
};

// Voxels where the speed function lets the surface grow: D > 0. It says nothing of a function that follows
// the surface.
struct SpeedStart {
  bool operator==(const SpeedStart&) const = default;
};

// A mask with the name of where it comes from ("truth.nii.gz", "label Liver"). With a limit the surface never
// leaves its neighbourhood: the mask is refined.
struct MaskStart {
  std::shared_ptr<const BitMask> mask;
  std::string origin;
  std::shared_ptr<const solver::MotionLimit> limit = nullptr;  // around the mask; null: none
  bool operator==(const MaskStart&) const = default;
};
// The same with a limit. Fails (ErrorKind::usage) unless that is above 0 mm.
Result<MaskStart> limited(MaskStart start, double within_mm);

// A level set that was saved.
struct FieldStart {
  std::shared_ptr<const solver::Field> phi;
  std::string origin;
  bool operator==(const FieldStart&) const = default;
};

// The first part, then seeds are added, then erasers are taken away. With more than one level the level set
// comes to rest on coarser grids first (document/coarse_levels.h), with the conditions of its first step.
struct Start {
  std::variant<std::monostate, ThresholdStart, FloodStart, SpeedStart, MaskStart, FieldStart> from;
  std::vector<solver::Sphere> seeds;
  std::vector<solver::Sphere> erasers;
  int levels = 1;  // to solver::CoarseGrid::kMostLevels

  // Masks, their limits and saved level sets are compared by their address.
  bool operator==(const Start&) const = default;
  // Whether it cannot be made without the function that drives the surface.
  [[nodiscard]] bool needs_speed() const { return levels > 1 || std::holds_alternative<SpeedStart>(from); }
  [[nodiscard]] bool empty() const { return std::holds_alternative<std::monostate>(from) && seeds.empty(); }
  // Of a mask that is refined; null: none.
  [[nodiscard]] std::shared_ptr<const solver::MotionLimit> limit() const;
  // What it consists of, for people: "mask truth.nii.gz", "1 seed".
  [[nodiscard]] std::vector<std::string> parts() const;
  // The same in one line.
  [[nodiscard]] std::string describe() const;
};

// The start that a phantom suggests: its seed (i, j, k in voxels, radius in mm), else its threshold (low,
// high). Empty where it has neither.
[[nodiscard]] Start suggested_start(const Geometry& geometry,
                                    const std::optional<std::array<double, 4>>& seed,
                                    const std::optional<std::pair<double, double>>& threshold);

// What holds the surface: walls and anchors over the limit; null: nothing.
[[nodiscard]] std::shared_ptr<const solver::Constraints> joined(
    std::shared_ptr<const solver::Constraints> marks, const solver::MotionLimit* limit);

// What a start is made from.
struct StartInputs {
  const Volume& source;                          // as the solver sees it
  const solver::SpeedFunction* speed = nullptr;  // that drives the surface; a SpeedStart needs it
};

// What is inside by the first part, on the grid of the source, which must outlive the result. None: there is
// none, or it is a saved level set. Fails as begin() does.
Result<std::optional<Inside>> inside_of(const Start& start, const StartInputs& inputs,
                                        const Progress& progress);
// Fails (ErrorKind::usage) when a seed or an eraser is outside the grid.
Status check_spheres(const Start& start, const Geometry& grid);
// Gives the executor its start in place of its phi; phi as it then is. Fails with ErrorKind::usage when a
// part is outside the volume, nothing is inside, or a SpeedStart's function follows the surface; phi is then
// as before.
Result<solver::Field> begin(solver::Executor& executor, const StartInputs& inputs, const Start& start,
                            const Progress& progress = {});

// The same as begin(), also where nothing is inside; after a failure phi is anything.
Result<solver::Field> place(solver::Executor& executor, const StartInputs& inputs, const Start& start,
                            const Progress& progress);

}  // namespace tidemark::document
