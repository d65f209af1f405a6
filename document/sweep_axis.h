// An axis of a sweep: a parameter and the values that it takes, one after the other.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"
#include "solver/parameters.h"
#include "solver/speed/speed_setting.h"

namespace tidemark::document {

struct SweepAxis {
  static constexpr int kMostValues = 8;

  std::string parameter;  // "alpha", or a number of a speed function: "edges.balloon"
  double from = 0.0;      // both ends are values of the axis
  double to = 0.0;
  int count = 2;

  // The index-th value, evenly between the ends. Rounded to 12 digits: as a table prints it, it is the same
  // number again.
  [[nodiscard]] double value(int index) const;
  bool operator==(const SweepAxis&) const = default;
};

// "alpha=0.2:0.9:6". Fails (ErrorKind::usage) naming the part that is wrong.
Result<SweepAxis> parse_sweep_axis(std::string_view text);

// The names that an axis may have where that drives the surface: alpha, rescale, target and range of the
// tent, and the numbers of the speed functions in use as FUNCTION.NAME. Not the band W, which the start
// depends on.
[[nodiscard]] std::vector<std::string> sweep_parameters(const solver::SpeedSetting& setting);

// One or two axes of different parameters, with values that the level set takes. Fails (ErrorKind::usage)
// naming the axis.
Status check(const std::vector<SweepAxis>& axes, const solver::Parameters& parameters,
             const solver::SpeedSetting& setting);

// Gives the parameter that value, in `parameters` or in `setting`. Its name is one of sweep_parameters().
void set_parameter(const std::string& name, double value, solver::Parameters& parameters,
                   solver::SpeedSetting& setting);
// Its present value; unset: the level set chooses it.
[[nodiscard]] std::optional<double> parameter_of(const std::string& name,
                                                 const solver::Parameters& parameters,
                                                 const solver::SpeedSetting& setting);
// Whether it is a number of a speed function.
[[nodiscard]] bool is_of_speed(std::string_view name);

}  // namespace tidemark::document
