#include "document/lesson_figure.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/index_walk.h"
#include "core/region.h"
#include "document/lesson_figure_names.h"
#include "document/segment_meshes.h"
#include "imaging/regions/islands.h"
#include "imaging/surface/surface.h"
#include "solver/ball.h"
#include "solver/distance_transform.h"
#include "solver/inside_region.h"
#include "solver/model.h"
#include "solver/statistics.h"
#include "solver/surface_agreement.h"

namespace tidemark::document {
namespace {

using Figure = Result<std::optional<double>>;

Figure volume(const LessonState& state, const Progress& /*progress*/) {
  return solver::measure(state.phi).volume_ml;
}

Figure area(const LessonState& state, const Progress& /*progress*/) {
  return solver::measure(state.phi).surface_mm2 / 100.0;
}

// Unset: the study is more than one slice, along whichever axis.
std::optional<double> thickness_of_slice_mm(const Geometry& grid) {
  for (const int axis : {2, 1, 0}) {
    if (grid.size[axis] == 1) return grid.spacing_mm[axis];
  }
  return std::nullopt;
}

// Of the ball, or in one slice the disc, of that volume.
Figure radius(const LessonState& state, const Progress& /*progress*/) {
  const double volume_ml = solver::measure(state.phi).volume_ml;
  const auto thickness_mm = thickness_of_slice_mm(state.phi.geometry);
  if (thickness_mm) return std::sqrt(1000.0 * volume_ml / *thickness_mm / std::numbers::pi);
  return solver::radius_of_ball_mm(volume_ml);
}

// With the faces where the study's end cuts the surface, as its volume is without what lies beyond.
Figure sphericity(const LessonState& state, const Progress& /*progress*/) {
  if (thickness_of_slice_mm(state.phi.geometry)) return std::nullopt;
  const auto surface = mesh_of(state.phi);
  if (!surface) return pass_on(surface);
  const double sphericity = imaging::mesh_sphericity(*surface);
  return sphericity > 0.0 ? std::optional(sphericity) : std::nullopt;
}

Figure bodies(const LessonState& state, const Progress& /*progress*/) {
  return static_cast<double>(imaging::Islands(solver::inside_region(state.phi)).count());
}

Figure steps(const LessonState& state, const Progress& /*progress*/) {
  return static_cast<double>(state.steps);
}

Figure rests(const LessonState& state, const Progress& /*progress*/) {
  return state.rests ? 1.0 : 0.0;
}

Figure time_step(const LessonState& state, const Progress& /*progress*/) {
  return state.time_step;
}

Figure overlap(const LessonState& state, const Progress& /*progress*/) {
  if (state.truth == nullptr) return std::nullopt;
  return dice(solver::inside_region(state.phi), Region(*state.truth));
}

Result<std::optional<solver::SurfaceDistance>> distance_to_truth(const LessonState& state,
                                                                 const Progress& progress) {
  if (state.truth == nullptr) return std::nullopt;
  // Its band is that of no try: one may have none.
  const solver::Field truth = solver::distance_transform(
      inside_of(*state.truth), solver::default_band(state.phi.geometry), state.phi.layout.page_shape());
  auto agreement = solver::agreement(state.phi, truth, progress);
  if (!agreement) return pass_on(agreement);
  return agreement->distance;
}

Figure mean_distance(const LessonState& state, const Progress& progress) {
  const auto distance = distance_to_truth(state, progress);
  if (!distance) return pass_on(distance);
  if (!*distance) return std::nullopt;
  return (*distance)->mean_mm;
}

Figure largest_distance(const LessonState& state, const Progress& progress) {
  const auto distance = distance_to_truth(state, progress);
  if (!distance) return pass_on(distance);
  if (!*distance) return std::nullopt;
  return (*distance)->largest_mm;
}

// Of the voxels that have a neighbour on the surface's other side, by central differences. 0: phi is a
// distance.
Figure gradient_error(const LessonState& state, const Progress& /*progress*/) {
  const solver::Field& phi = state.phi;
  const Geometry& grid = phi.geometry;
  const double smallest = std::min({grid.spacing_mm.x, grid.spacing_mm.y, grid.spacing_mm.z});
  double sum = 0.0;
  std::int64_t count = 0;
  const auto look_at = [&](Index3 voxel) {
    const bool inside = phi.at(voxel) > 0.0F;
    bool beside_surface = false;
    double squares = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
      Index3 before = voxel;
      Index3 behind = voxel;
      before[axis] = std::max<std::int64_t>(voxel[axis] - 1, 0);
      behind[axis] = std::min(voxel[axis] + 1, grid.size[axis] - 1);
      const float low = phi.at(before);
      const float high = phi.at(behind);
      beside_surface = beside_surface || (low > 0.0F) != inside || (high > 0.0F) != inside;
      if (before == behind) continue;
      const double length =
          static_cast<double>(behind[axis] - before[axis]) * grid.spacing_mm[axis] / smallest;
      squares += std::pow((high - low) / length, 2);
    }
    if (!beside_surface) return;
    sum += std::abs(std::sqrt(squares) - 1.0);
    ++count;
  };
  for (std::int64_t page = 0; page < phi.layout.page_count(); ++page) {
    if (!phi.pages.is_stored(page)) continue;
    const Index3 first = phi.layout.first_voxel(page);
    for_each_index(first, first + phi.layout.valid_shape(page), look_at);
  }
  if (count == 0) return std::nullopt;
  return sum / static_cast<double>(count);
}

Figure resident_pages(const LessonState& state, const Progress& /*progress*/) {
  return static_cast<double>(state.memory.resident_pages);
}

Figure resident_share(const LessonState& state, const Progress& /*progress*/) {
  return 100.0 * static_cast<double>(state.phi.pages.stored()) /
         static_cast<double>(state.phi.layout.page_count());
}

Figure memory(const LessonState& state, const Progress& /*progress*/) {
  return static_cast<double>(state.memory.state_bytes) / (1 << 20);
}

constexpr LessonFigure kFigures[] = {
    {"volume_ml", "ml", "Volume", 2, volume},
    {"area_cm2", "cm²", "Area", 1, area},
    {"radius_mm", "mm", "Radius of the ball of that volume", 2, radius},
    {"sphericity", "", "Roundness (1: a ball)", 2, sphericity},
    {"bodies", "", "Separate bodies", 0, bodies},
    {"steps", "", "Steps since the start", 0, steps},
    {"rests", "", "Rests (1: yes, 0: no)", 0, rests},
    {"time_step", "", "Time step", 4, time_step},
    {"dice", "", "Dice", 3, overlap},
    {"mean_distance_mm", "mm", "Mean distance to the truth", 2, mean_distance},
    {"largest_distance_mm", "mm", "Largest distance to the truth", 2, largest_distance},
    {"gradient_error", "", "Mean departure of |∇φ| from 1 beside the surface", 2, gradient_error},
    {"resident_pages", "", "Resident pages", 0, resident_pages},
    {"resident_percent", "%", "Pages that are resident", 2, resident_share},
    {"memory_mib", "MiB", "Memory of the level set", 1, memory},
};

static_assert(std::equal(std::begin(kFigures), std::end(kFigures), kFigureNames.begin(), kFigureNames.end(),
                         [](const LessonFigure& figure, std::string_view name) {
                           return figure.name == name;
                         }));

}  // namespace

std::span<const LessonFigure> lesson_figures() {
  return kFigures;
}

const LessonFigure* lesson_figure(std::string_view name) {
  const auto* found = std::find_if(std::begin(kFigures), std::end(kFigures),
                                   [&](const LessonFigure& figure) { return figure.name == name; });
  return found == std::end(kFigures) ? nullptr : found;
}

}  // namespace tidemark::document
