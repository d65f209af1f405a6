#include "imaging/phantom/phantom_name.h"

#include <algorithm>

#include "core/number_from.h"
#include "imaging/phantom/kinds.h"

namespace tidemark::imaging {

const std::vector<std::string_view>& phantom_kinds() {
  static const std::vector<std::string_view> kKinds(phantom::kNames.begin(), phantom::kNames.end());
  return kKinds;
}

Result<PhantomName> parse_phantom_name(std::string_view name) {
  const std::size_t colon = name.find(':');
  PhantomName parsed{std::string(name.substr(0, colon)), {}};
  const auto& kinds = phantom_kinds();
  if (std::find(kinds.begin(), kinds.end(), parsed.kind) == kinds.end()) {
    return fail(ErrorKind::usage, "unknown phantom '{}'; there are {}", parsed.kind, fmt::join(kinds, ", "));
  }
  if (colon == std::string_view::npos) return parsed;
  const std::string_view noise = name.substr(colon + 1);
  const auto percent = number_from<double>(noise);
  if (!percent || *percent < 0.0 || *percent > 100.0) {
    return fail(ErrorKind::usage, "noise of '{}' %: a number from 0 to 100 is needed", noise);
  }
  parsed.options.noise_percent = *percent;
  return parsed;
}

}  // namespace tidemark::imaging
