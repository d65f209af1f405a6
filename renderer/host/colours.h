// Colours with a meaning: the processor's side of resources/shaders/render/colours.glsl.
#pragma once

#include <algorithm>
#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include "renderer/host/phi_pages.h"

namespace tidemark::renderer {

inline constexpr glm::vec3 kOutlineYellow(1.0F, 0.85F, 0.0F);
// Of contours of phi outside and inside.
inline constexpr glm::vec3 kContourOutside(0.45F, 0.75F, 1.0F);
inline constexpr glm::vec3 kContourInside(1.0F, 0.60F, 0.30F);

// Blue below 0 and orange above, told apart by colour-blind people, too.
inline glm::vec3 diverging(float x) {
  constexpr glm::vec3 kCold(0.13F, 0.36F, 0.67F);
  constexpr glm::vec3 kWarm(0.80F, 0.40F, 0.05F);
  constexpr glm::vec3 kMiddle(0.95F);
  return x < 0.0F ? glm::mix(kMiddle, kCold, std::min(-x, 1.0F))
                  : glm::mix(kMiddle, kWarm, std::min(x, 1.0F));
}

// Doubt from 0 to 1: the darker the surer, in a hue that means nothing else.
inline glm::vec3 doubt_colour(float doubt) {
  return glm::mix(glm::vec3(0.30F, 0.05F, 0.42F), glm::vec3(1.0F, 0.80F, 0.95F), doubt);
}

inline glm::vec3 page_colour(PageState state) {
  switch (state) {
    case PageState::new_page:
      return {0.85F, 0.35F, 0.60F};
    case PageState::quiet:
      return {0.10F, 0.62F, 0.47F};
    case PageState::resident:
      return {0.20F, 0.55F, 0.85F};
    case PageState::inside:
      return {0.90F, 0.75F, 0.30F};
    case PageState::outside:
      break;
  }
  return glm::vec3(0.35F);
}

}  // namespace tidemark::renderer
