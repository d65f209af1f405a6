#include "core/label_colour.h"

#include <algorithm>

namespace tidemark {

// Easy to tell apart, also for people who see few colours (after Okabe and Ito). Those that resemble the
// outline's yellow and the speed map's orange come late. Then around the circle of hues.
std::array<std::uint8_t, 3> label_colour(std::uint8_t id) {
  constexpr std::array<std::array<std::uint8_t, 3>, 7> kFirst{{{86, 180, 233},
                                                               {0, 158, 115},
                                                               {204, 121, 167},
                                                               {0, 114, 178},
                                                               {213, 94, 0},
                                                               {230, 159, 0},
                                                               {240, 228, 66}}};
  if (id <= kFirst.size()) return kFirst[id - 1U];
  // Steps of the golden ratio never come back to the same hue; brightness alternates.
  const double turns = 0.618033988749895 * id;
  const double hue = 6.0 * (turns - static_cast<double>(static_cast<int>(turns)));
  const double bright = id % 2 == 0 ? 255.0 : 190.0;
  const auto channel = [&](double offset) {
    double h = hue + offset;
    if (h >= 6.0) h -= 6.0;
    const double ramp = std::clamp(h < 3.0 ? h : 6.0 - h, 1.0, 2.0) - 1.0;  // 0..1
    return static_cast<std::uint8_t>(bright * (0.25 + 0.75 * ramp));
  };
  return {channel(2.0), channel(0.0), channel(4.0)};
}

}  // namespace tidemark
