// The places of the slices of a stack: how far along their normal, how far to its side, and on which even
// scale. Private to imaging.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

namespace tidemark::imaging {

// Whether a distance (mm) is the wanted one but for rounding in files.
[[nodiscard]] bool is_distance(double distance, double wanted);

// Whether slices that move sideways so far over a length (both mm) lie above each other but for rounding.
[[nodiscard]] bool is_straight(double sideways, double length);

// In mm from the first slice; ascending along the normal. At least two slices.
struct SlicePlaces {
  std::vector<double> along;         // the normal
  std::vector<glm::dvec2> sideways;  // along i and j

  [[nodiscard]] std::size_t last() const { return along.size() - 1; }
  [[nodiscard]] double step(std::size_t k) const { return along[k + 1] - along[k]; }
};

SlicePlaces places_of(const std::vector<glm::dvec3>& positions_mm, const glm::dmat3& axes);

// The sideways movement of slices as they advance.
struct SliceTilt {
  double degrees = 0.0;               // 0: they lie above each other
  std::optional<std::size_t> uneven;  // the first step that is not in proportion
};

SliceTilt tilt_of(const SlicePlaces& places);

// The places of slices on an even scale, in its steps: whole numbers unless the slices are uneven.
struct SliceScale {
  enum class Kind { even, missing, uneven };
  Kind kind = Kind::even;
  double step_mm = 1.0;
  std::vector<double> places;

  [[nodiscard]] std::int64_t slices() const;  // of a grid with these steps, from the first slice to the last
  // How many slices are missing between slice k and the next.
  [[nodiscard]] std::int64_t missing_after(std::size_t k) const;
};

// The step is the mean distance, of slices with gaps the mean but for them, of uneven ones the smallest that
// is usual.
SliceScale scale_of(const SlicePlaces& places);

}  // namespace tidemark::imaging
