#include "solver/speed/speed_registry.h"

#include <algorithm>
#include <cmath>

#include "solver/speed/cached_speed.h"
#include "solver/speed/combined_speed.h"
#include "solver/speed/speed_kinds.h"
#include "solver/speed/tent_speed.h"

namespace tidemark::solver {
namespace {

const SpeedParameter* parameter(const SpeedKind& kind, std::string_view name) {
  const auto found = std::find_if(kind.parameters.begin(), kind.parameters.end(),
                                  [&](const SpeedParameter& p) { return p.name == name; });
  return found == kind.parameters.end() ? nullptr : &*found;
}

// "tent, regions, edges"
std::string names() {
  std::string all;
  for (const SpeedKind& kind : speed_kinds()) all += (all.empty() ? "" : ", ") + std::string(kind.name);
  return all;
}

Status check(const SpeedTerm& term) {
  const SpeedKind* kind = speed_kind(term.function);
  if (kind == nullptr) {
    return fail(ErrorKind::usage, "there is no speed function \"{}\"; there are {}", term.function, names());
  }
  for (const auto& [name, value] : term.values) {
    const SpeedParameter* number = parameter(*kind, name);
    if (number == nullptr) {
      return fail(ErrorKind::usage, "the speed function {} has no number \"{}\"", kind->name, name);
    }
    if (!(value >= number->low && value <= number->high)) {
      return fail(ErrorKind::usage, "the speed function {}: {} must lie between {} and {}, not {}",
                  kind->name, name, number->low, number->high, value);
    }
    if (!number->choices.empty() && value != std::round(value)) {
      return fail(ErrorKind::usage, "the speed function {}: {} must be a whole number, not {}", kind->name,
                  name, value);
    }
  }
  return {};
}

Result<std::shared_ptr<const SpeedFunction>> make_term(const SpeedTerm& term, const SpeedInputs& inputs,
                                                       const Progress& progress) {
  const SpeedKind& kind = *speed_kind(term.function);
  if (kind.needs_strokes && inputs.strokes == nullptr) {
    return fail(ErrorKind::usage, "the speed function {} needs strokes inside and outside", kind.name);
  }
  if (kind.needs_map && inputs.map == nullptr) {
    return fail(ErrorKind::usage, "the speed function {} needs a map", kind.name);
  }
  std::map<std::string, double> values = term.values;
  for (const SpeedParameter& number : kind.parameters) values.try_emplace(number.name, number.initial);
  auto made = kind.make(inputs, values, progress);
  if (!made || !kind.cached) return made;
  return std::make_shared<CachedSpeed>(std::move(*made), inputs.source->geometry.size);
}

Status can_be_joined(const Tent& tent) {
  if (!tent.is_raw()) return {};
  return fail(ErrorKind::usage, "the raw form of the tent cannot be joined with other speed functions");
}

}  // namespace

const std::vector<SpeedKind>& speed_kinds() {
  static const std::vector<SpeedKind> kinds{tent_kind(), regions_kind(), edges_kind(), examples_kind(),
                                            image_kind()};
  return kinds;
}

const SpeedKind* speed_kind(std::string_view name) {
  const auto& kinds = speed_kinds();
  const auto found =
      std::find_if(kinds.begin(), kinds.end(), [&](const SpeedKind& kind) { return kind.name == name; });
  return found == kinds.end() ? nullptr : &*found;
}

bool any_has(const SpeedSetting& setting, bool SpeedKind::*property) {
  return std::any_of(setting.terms.begin(), setting.terms.end(), [property](const SpeedTerm& term) {
    const SpeedKind* kind = speed_kind(term.function);
    return kind != nullptr && kind->*property;
  });
}

Status check(const SpeedSetting& setting) {
  if (setting.terms.empty()) return fail(ErrorKind::usage, "no speed function is chosen");
  for (const SpeedTerm& term : setting.terms) TIDEMARK_TRY(check(term));
  return {};
}

Result<std::shared_ptr<const SpeedFunction>> make_speed(const SpeedSetting& setting,
                                                        const SpeedInputs& inputs, const Progress& progress) {
  TIDEMARK_TRY(check(setting));
  if (setting.is_tent()) return nullptr;
  const int count = static_cast<int>(setting.terms.size());
  std::vector<std::shared_ptr<const SpeedFunction>> functions;
  for (int i = 0; i < count; ++i) {
    if (progress.cancelled()) return cancelled_error();
    auto made = make_term(setting.terms[static_cast<std::size_t>(i)], inputs, progress.part(i, count));
    if (!made) return made;
    functions.push_back(std::move(*made));
    if (const Tent* tent = functions.back()->tent(); count > 1 && tent != nullptr) {
      TIDEMARK_TRY(can_be_joined(*tent));
    }
  }
  if (count == 1) return functions.front();
  return std::make_shared<CombinedSpeed>(std::move(functions), setting.combine);
}

Result<std::shared_ptr<const SpeedFunction>> with_tents(std::shared_ptr<const SpeedFunction> function,
                                                        const std::shared_ptr<const Volume>& source,
                                                        const Parameters& parameters) {
  const auto* joined = dynamic_cast<const CombinedSpeed*>(function.get());
  if (joined == nullptr) return function;
  TIDEMARK_TRY(can_be_joined(tent_of(parameters)));
  return joined->with_tents(source, parameters);
}

}  // namespace tidemark::solver
