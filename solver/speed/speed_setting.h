// The choice of what drives the surface, as a value: speed functions with their numbers, and how they are
// joined.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/result.h"

namespace tidemark::solver {

// One speed function of the registry; a number that is not given has its initial value there. T, epsilon and
// the form of the tent are in Parameters.
struct SpeedTerm {
  std::string function = "tent";
  std::map<std::string, double> values;

  bool operator==(const SpeedTerm&) const = default;
};

// How the D of several functions become one.
enum class Combine {
  least,    // the least: the surface grows where all of them let it
  product,  // as independent probabilities p = (D + 1) / 2: D = 2 product(p) - 1
};

struct SpeedSetting {
  std::vector<SpeedTerm> terms{SpeedTerm{}};
  Combine combine = Combine::least;

  // Nothing but the tent, which every executor evaluates from T and epsilon itself.
  [[nodiscard]] bool is_tent() const { return terms.size() == 1 && terms.front().function == "tent"; }
  bool operator==(const SpeedSetting&) const = default;
};

}  // namespace tidemark::solver
