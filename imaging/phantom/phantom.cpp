#include "imaging/phantom/phantom.h"

#include <algorithm>
#include <cmath>

#include "imaging/phantom/kinds.h"

namespace tidemark::imaging {
namespace phantom {
namespace {

struct Kind {
  std::string_view name;
  Builder build;
  std::string_view truth;
};

constexpr Kind kKinds[] = {
    {"sphere", make_sphere, "the ball of radius 20 mm"},
    {"dumbbell", make_dumbbell, "both balls and the neck between them"},
    {"bridge", make_bridge, "the ball that holds the seed, without the bridge and the other ball"},
    {"tumour", make_tumour, "the tumour"},
    {"cortex", make_cortex, "the folded sheet"},
    {"organ", make_organ, "the tissue of the organ, without its vessels"},
    {"junction", make_junction, "both membranes and the bodies that bridge the gap between them"},
    {"head", make_head, "the white matter, brain stem included"},
};

// Names are known where nothing is built (phantom_name.cpp).
static_assert(std::equal(std::begin(kKinds), std::end(kKinds), kNames.begin(), kNames.end(),
                         [](const Kind& kind, std::string_view name) { return kind.name == name; }));

const Kind* find(std::string_view name) {
  const auto* found =
      std::find_if(std::begin(kKinds), std::end(kKinds), [&](const Kind& kind) { return kind.name == name; });
  return found == std::end(kKinds) ? nullptr : found;
}

}  // namespace

Result<Phantom> make_on(ThreadPool& pool, std::string_view kind, const PhantomOptions& options,
                        const Progress& progress) {
  const Kind* found = find(kind);
  if (found == nullptr) {
    return fail(ErrorKind::usage, "unknown phantom '{}'; there are {}", kind,
                fmt::join(phantom_kinds(), ", "));
  }
  if (!std::isfinite(options.noise_percent) || options.noise_percent > 100.0) {
    return fail(ErrorKind::usage, "noise of {} %: it must be at most 100", options.noise_percent);
  }
  Result<Phantom> made = found->build(options, pool, progress);
  if (made) made->kind = found->name;
  return made;
}

std::string_view truth_of(std::string_view kind) {
  const Kind* found = find(kind);
  return found == nullptr ? std::string_view() : found->truth;
}

}  // namespace phantom

Result<Phantom> make_phantom(std::string_view kind, const PhantomOptions& options, const Progress& progress) {
  ThreadPool pool;
  return phantom::make_on(pool, kind, options, progress);
}

}  // namespace tidemark::imaging
