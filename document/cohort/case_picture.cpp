#include "document/cohort/case_picture.h"

#include <algorithm>

#include "renderer/host/host_renderer.h"
#include "renderer/sheet.h"

namespace tidemark::cohort {
namespace {

using renderer::Picture;

constexpr int kParts = 4;

// A pointer to what somebody else holds for longer.
template <class T>
std::shared_ptr<const T> borrowed(const T& value) {
  return {std::shared_ptr<const T>(), &value};
}

void put(Picture& whole, const Picture& part, std::int64_t index) {
  for (std::int64_t y = 0; y < part.height; ++y) {
    const auto from = part.pixels.begin() + 4 * y * part.width;
    std::copy(from, from + 4 * part.width, whole.pixels.begin() + 4 * (y * whole.width + index * part.width));
  }
}

}  // namespace

Result<Picture> case_picture(const Volume& source, const solver::Field& phi, std::int64_t side, int threads) {
  auto renderer = renderer::HostRenderer::create(borrowed(source), phi.layout, threads);
  if (!renderer) return pass_on(renderer);
  TIDEMARK_TRY((*renderer)->set_phi(borrowed(phi), {}));
  Picture whole{kParts * side, side, {}};
  whole.pixels.resize(static_cast<std::size_t>(4 * whole.width * whole.height));
  std::int64_t index = 0;
  renderer::SliceView slice;
  slice.position_mm = renderer::middle_of(phi);
  slice.window = renderer::window_of(source);
  slice.line_pixels = 1.5;
  for (const auto& orientation : {renderer::kAxial, renderer::kCoronal, renderer::kSagittal}) {
    slice.orientation = orientation;
    const auto picture = (*renderer)->draw(slice, {side, side});
    if (!picture) return picture;
    put(whole, *picture, index++);
  }
  renderer::VolumeView view;
  view.camera.azimuth = 30.0;
  view.camera.elevation = 20.0;
  view.camera = view.camera.on(renderer::box_around(phi), source.geometry, 1.0);
  view.background = glm::vec3(0.0F);
  const auto picture = (*renderer)->draw(view, {side, side});
  if (!picture) return picture;
  put(whole, *picture, index);
  return whole;
}

}  // namespace tidemark::cohort
