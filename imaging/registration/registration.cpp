#include "imaging/registration/registration.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec4.hpp>
#include <iterator>
#include <new>

#include "imaging/onto_grid.h"
#include "imaging/registration/maximise.h"
#include "imaging/registration/pyramid.h"

namespace tidemark::imaging {
namespace {

// The part of the work that makes both pyramids.
constexpr double kPyramidsPart = 0.1;

// The numbers of a transform from a file may be rounded; the search takes rotations alone.
glm::dmat4 without_rounding(const glm::dmat4& rigid) {
  const glm::dvec3 x = glm::normalize(glm::dvec3(rigid[0]));
  const glm::dvec3 z = glm::normalize(glm::cross(x, glm::dvec3(rigid[1])));
  return {glm::dvec4(x, 0.0), glm::dvec4(glm::cross(z, x), 0.0), glm::dvec4(z, 0.0), rigid[3]};
}

// Where the search begins.
struct Guess {
  glm::dmat4 to_moving;  // from the fixed image
  bool is_start;         // otherwise the centres are put on one another
};

Guess first_guess(const Geometry& moving, const Geometry& fixed, const glm::dmat4& start) {
  const glm::dmat4 to_moving = glm::inverse(start);
  const glm::dvec3 of_moving = registration::centre_mm(moving);
  const glm::dvec3 of_fixed = registration::centre_mm(fixed);
  const glm::dvec3 there(to_moving * glm::dvec4(of_fixed, 1.0));
  const glm::dvec3 here(start * glm::dvec4(of_moving, 1.0));
  if (moving.covers(there) || fixed.covers(here)) return {to_moving, true};
  glm::dmat4 centred = to_moving;
  centred[3] += glm::dvec4(of_moving - there, 0.0);
  return {centred, false};
}

Status require_contrast(const Volume& image, const char* which) {
  const auto [low, high] = image.common_range();
  if (low < high) return {};
  return fail(ErrorKind::usage, "registration: the {} image of {} has a single value", which,
              describe(image.geometry));
}

// A single slice fits as well wherever the other image looks the same.
Status require_depth(const Volume& image, const char* which) {
  const Index3 size = image.geometry.size;
  if (std::min({size.x, size.y, size.z}) > 1) return {};
  return fail(ErrorKind::usage,
              "registration: the {} image of {} is a single slice, whose place across it cannot be found",
              which, describe(image.geometry));
}

// The part of a progress that runs from `begin` to `end`.
Progress between(const Progress& progress, double begin, double end) {
  Progress part{nullptr, progress.stop};
  if (progress.report) {
    part.report = [report = progress.report, begin, end](double fraction, std::string_view what) {
      report(begin + (end - begin) * fraction, what);
    };
  }
  return part;
}

Result<Registration> run(const Volume& moving, const Volume& fixed, const glm::dmat4& start,
                         const Progress& progress) {
  progress(0.0, "registering");
  const auto moving_levels = registration::make_pyramid(moving, progress);
  if (!moving_levels) return pass_on(moving_levels);
  progress(0.5 * kPyramidsPart, "registering");
  const auto fixed_levels = registration::make_pyramid(fixed, progress);
  if (!fixed_levels) return pass_on(fixed_levels);

  const Progress search = between(progress, kPyramidsPart, 1.0);
  const auto levels = static_cast<int>(std::size(registration::kLevelsMm));
  const Guess guess = first_guess(moving.geometry, fixed.geometry, without_rounding(start));
  glm::dmat4 to_moving = guess.to_moving;
  double after = 0.0;
  for (int level = 0; level < levels; ++level) {
    const auto index = static_cast<std::size_t>(level);
    const auto maximum =
        registration::maximise((*moving_levels)[index], (*fixed_levels)[index], to_moving,
                               0.5 * registration::kLevelsMm[index], search.part(level, levels));
    if (!maximum) return pass_on(maximum);
    to_moving = maximum->to_moving;
    after = maximum->information;
  }
  Registration result = describe_rigid(glm::inverse(to_moving), registration::centre_mm(moving.geometry));
  result.information_after = after;
  if (guess.is_start) {
    // On the same level and the same samples as the end.
    const auto before =
        registration::information(moving_levels->back(), fixed_levels->back(), guess.to_moving);
    if (!before) return pass_on(before);
    result.information_before = *before;
  }
  progress(1.0, "registering");
  return result;
}

}  // namespace

Registration describe_rigid(const glm::dmat4& transform, glm::dvec3 centre_mm) {
  Registration result;
  result.to_fixed = transform;
  // The angle by the skew part: the trace alone is blunt near 0.
  const glm::dvec3 twice_sine(transform[1][2] - transform[2][1], transform[2][0] - transform[0][2],
                              transform[0][1] - transform[1][0]);
  const double trace = transform[0][0] + transform[1][1] + transform[2][2];
  result.rotation_degrees = glm::degrees(std::atan2(glm::length(twice_sine), trace - 1.0));
  result.translation_mm = glm::dvec3(transform * glm::dvec4(centre_mm, 1.0)) - centre_mm;
  return result;
}

Result<Registration> register_rigidly(const Volume& moving, const Volume& fixed, const glm::dmat4& start,
                                      const Progress& progress) {
  TIDEMARK_TRY(require_depth(moving, "moving"));
  TIDEMARK_TRY(require_depth(fixed, "fixed"));
  TIDEMARK_TRY(require_contrast(moving, "moving"));
  TIDEMARK_TRY(require_contrast(fixed, "fixed"));
  try {
    return run(moving, fixed, start, progress);
  } catch (const std::bad_alloc&) {
    return fail(ErrorKind::capability, "registration: not enough memory for {} and {}",
                describe(moving.geometry), describe(fixed.geometry));
  }
}

}  // namespace tidemark::imaging
