#include "document/sweep_axis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/number_from.h"
#include "solver/speed/speed_registry.h"

namespace tidemark::document {
namespace {

bool uses(const solver::SpeedSetting& setting, std::string_view function) {
  return std::any_of(setting.terms.begin(), setting.terms.end(),
                     [&](const solver::SpeedTerm& term) { return term.function == function; });
}

std::pair<std::string, std::string> function_and_number(const std::string& name) {
  const std::size_t dot = name.find('.');
  return {name.substr(0, dot), name.substr(dot + 1)};
}

Status check(const SweepAxis& axis, solver::Parameters parameters, solver::SpeedSetting setting) {
  const std::vector<std::string> known = sweep_parameters(setting);
  if (std::find(known.begin(), known.end(), axis.parameter) == known.end()) {
    return fail(ErrorKind::usage, "{}: there is no such parameter here; there are {}", axis.parameter,
                fmt::join(known, ", "));
  }
  if (axis.count < 2 || axis.count > SweepAxis::kMostValues) {
    return fail(ErrorKind::usage, "{}: 2 to {} values are possible, not {}", axis.parameter,
                SweepAxis::kMostValues, axis.count);
  }
  if (!(axis.from < axis.to)) {
    return fail(ErrorKind::usage, "{}: the first value, {}, must be below the last, {}", axis.parameter,
                axis.from, axis.to);
  }
  for (int i = 0; i < axis.count; ++i) {
    set_parameter(axis.parameter, axis.value(i), parameters, setting);
    TIDEMARK_TRY(solver::check(parameters));
    TIDEMARK_TRY(solver::check(setting));
  }
  return {};
}

}  // namespace

double SweepAxis::value(int index) const {
  if (count < 2) return from;
  const double exact = from + (to - from) * index / (count - 1);
  return number_from<double>(fmt::format("{:.12g}", exact)).value_or(exact);
}

Result<SweepAxis> parse_sweep_axis(std::string_view text) {
  const std::size_t equal = text.find('=');
  const std::size_t first = equal == std::string_view::npos ? equal : text.find(':', equal);
  const std::size_t second = first == std::string_view::npos ? first : text.find(':', first + 1);
  if (equal == 0 || second == std::string_view::npos) {
    return fail(ErrorKind::usage, "{}: NAME=FROM:TO:COUNT is needed", text);
  }
  SweepAxis axis{std::string(text.substr(0, equal))};
  for (const auto& [part, number] : {std::pair(text.substr(equal + 1, first - equal - 1), &axis.from),
                                     std::pair(text.substr(first + 1, second - first - 1), &axis.to)}) {
    const auto read = number_from<double>(part);
    if (!read) return fail(ErrorKind::usage, "{}: '{}' is not a finite number", text, part);
    *number = *read;
  }
  const auto count = number_from<double>(text.substr(second + 1));
  if (!count || *count != std::round(*count) || *count < 2 || *count > SweepAxis::kMostValues) {
    return fail(ErrorKind::usage, "{}: '{}' is not a whole number from 2 to {}", text,
                text.substr(second + 1), SweepAxis::kMostValues);
  }
  axis.count = static_cast<int>(*count);
  return axis;
}

std::vector<std::string> sweep_parameters(const solver::SpeedSetting& setting) {
  std::vector<std::string> names{"alpha"};
  if (uses(setting, "tent")) names.insert(names.end(), {"range", "target"});
  names.emplace_back("rescale");
  for (const solver::SpeedTerm& term : setting.terms) {
    const solver::SpeedKind* kind = solver::speed_kind(term.function);
    if (kind == nullptr) continue;
    for (const auto& number : kind->parameters) names.push_back(term.function + "." + number.name);
  }
  return names;
}

Status check(const std::vector<SweepAxis>& axes, const solver::Parameters& parameters,
             const solver::SpeedSetting& setting) {
  if (axes.empty() || axes.size() > 2) {
    return fail(ErrorKind::usage, "a sweep goes over one or two parameters, not {}", axes.size());
  }
  for (const SweepAxis& axis : axes) TIDEMARK_TRY(check(axis, parameters, setting));
  if (axes.front().parameter == axes.back().parameter && axes.size() == 2) {
    return fail(ErrorKind::usage, "{}: is both axes of the sweep", axes.front().parameter);
  }
  return {};
}

bool is_of_speed(std::string_view name) {
  return name.find('.') != std::string_view::npos;
}

void set_parameter(const std::string& name, double value, solver::Parameters& parameters,
                   solver::SpeedSetting& setting) {
  if (name == "alpha") parameters.alpha = value;
  if (name == "range") parameters.range = value;
  if (name == "target") parameters.target = value;
  if (name == "rescale") parameters.rescale = value;
  if (!is_of_speed(name)) return;
  const auto [function, number] = function_and_number(name);
  for (solver::SpeedTerm& term : setting.terms) {
    if (term.function == function) term.values[number] = value;
  }
}

std::optional<double> parameter_of(const std::string& name, const solver::Parameters& parameters,
                                   const solver::SpeedSetting& setting) {
  if (name == "alpha") return parameters.alpha;
  if (name == "range") return parameters.range;
  if (name == "target") return parameters.target;
  if (name == "rescale") return parameters.rescale;
  const auto [function, number] = function_and_number(name);
  for (const solver::SpeedTerm& term : setting.terms) {
    if (term.function != function) continue;
    if (const auto given = term.values.find(number); given != term.values.end()) return given->second;
    for (const auto& known : solver::speed_kind(function)->parameters) {
      if (number == known.name) return known.initial;
    }
  }
  return std::nullopt;
}

}  // namespace tidemark::document
