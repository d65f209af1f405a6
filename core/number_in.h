// The number of a place in a box, the first axis fastest.
#pragma once

#include <glm/vec3.hpp>

namespace tidemark {

template <glm::length_t kAxes, class T, glm::qualifier kQualifier>
[[nodiscard]] constexpr T number_in(const glm::vec<kAxes, T, kQualifier>& box,
                                    const glm::vec<kAxes, T, kQualifier>& at) {
  // Written out, as builds without optimisation do not unroll the loop.
  if constexpr (kAxes == 3) return at.x + box.x * (at.y + box.y * at.z);
  T number = 0;
  for (glm::length_t axis = kAxes; axis-- > 0;) number = number * box[axis] + at[axis];
  return number;
}

}  // namespace tidemark
