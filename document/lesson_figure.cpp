#include "document/lesson_figure.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "document/inside_bits.h"
#include "imaging/filters/filters.h"
#include "solver/distance_transform.h"
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

// Of the ball, or in one slice the disc, of that volume.
Figure radius(const LessonState& state, const Progress& /*progress*/) {
  const double mm3 = solver::measure(state.phi).volume_ml * 1000.0;
  const Geometry& grid = state.phi.geometry;
  if (grid.size.z == 1) return std::sqrt(mm3 / grid.spacing_mm.z / std::numbers::pi);
  return std::cbrt(mm3 * 3.0 / (4.0 * std::numbers::pi));
}

Figure bodies(const LessonState& state, const Progress& /*progress*/) {
  return static_cast<double>(imaging::connected_components(state.phi.mask()).count);
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
  return dice(InsideBits(state.phi), InsideBits(*state.truth));
}

Result<std::optional<solver::SurfaceDistance>> distance_to_truth(const LessonState& state,
                                                                 const Progress& progress) {
  if (state.truth == nullptr) return std::nullopt;
  const solver::Field truth =
      solver::distance_transform(*state.truth, state.phi.band, state.phi.layout.page_shape());
  auto agreement = solver::agreement(state.phi, truth, progress);
  if (!agreement) return pass_on(agreement);
  return agreement->distance;
}

Figure mean_distance(const LessonState& state, const Progress& progress) {
  const auto distance = distance_to_truth(state, progress);
  if (!distance) return tl::unexpected<Error>(distance.error());
  if (!*distance) return std::nullopt;
  return (*distance)->mean_mm;
}

Figure largest_distance(const LessonState& state, const Progress& progress) {
  const auto distance = distance_to_truth(state, progress);
  if (!distance) return tl::unexpected<Error>(distance.error());
  if (!*distance) return std::nullopt;
  return (*distance)->largest_mm;
}

Figure resident_pages(const LessonState& state, const Progress& /*progress*/) {
  return static_cast<double>(state.memory.resident_pages);
}

Figure resident_share(const LessonState& state, const Progress& /*progress*/) {
  return 100.0 * static_cast<double>(state.phi.resident_pages()) /
         static_cast<double>(state.phi.layout.page_count());
}

Figure memory(const LessonState& state, const Progress& /*progress*/) {
  return static_cast<double>(state.memory.state_bytes) / (1 << 20);
}

constexpr LessonFigure kFigures[] = {
    {"volume_ml", "ml", "Volume", 2, volume},
    {"area_cm2", "cm²", "Area", 1, area},
    {"radius_mm", "mm", "Radius of the ball of that volume", 2, radius},
    {"bodies", "", "Separate bodies", 0, bodies},
    {"steps", "", "Steps since the start", 0, steps},
    {"rests", "", "Rests (1: yes, 0: no)", 0, rests},
    {"time_step", "", "Time step", 4, time_step},
    {"dice", "", "Dice", 3, overlap},
    {"mean_distance_mm", "mm", "Mean distance to the truth", 2, mean_distance},
    {"largest_distance_mm", "mm", "Largest distance to the truth", 2, largest_distance},
    {"resident_pages", "", "Resident pages", 0, resident_pages},
    {"resident_percent", "%", "Pages that are resident", 2, resident_share},
    {"memory_mib", "MiB", "Memory of the level set", 1, memory},
};

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
