#include "imaging/phantom/phantom_name.h"

#include <algorithm>
#include <charconv>

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
  double& percent = parsed.options.noise_percent;
  const auto [end, error] = std::from_chars(noise.data(), noise.data() + noise.size(), percent);
  if (error != std::errc() || end != noise.data() + noise.size() || !(percent >= 0.0 && percent <= 100.0)) {
    return fail(ErrorKind::usage, "noise of '{}' %: a number from 0 to 100 is needed", noise);
  }
  return parsed;
}

}  // namespace tidemark::imaging
