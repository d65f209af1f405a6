#include "renderer/gl/canvas_mean.h"

namespace tidemark::renderer {

Result<CanvasMean> CanvasMean::create(gpu::Device& device) {
  auto weighted = gpu::Program::render(device, "render/full_view.vert", "", "render/weighted.frag", {});
  if (!weighted) return pass_on(weighted);
  CanvasMean mean;
  mean.weighted_ = std::move(*weighted);
  return mean;
}

void CanvasMean::use(const Canvas& picture, float weight) const {
  constexpr int kUnit = 0;
  weighted_.use();
  picture.colour().bind(kUnit);
  weighted_.set("picture", kUnit);
  weighted_.set("weight", weight);
}

Status CanvasMean::replace_by_mean(gpu::Device& device, Canvas& picture) {
  if (sum_.size() != picture.size()) {
    // Half floats: a few pictures' sum is exact to a small part of what 8 bits tell apart.
    auto sum = Canvas::create(device, picture.size(), gpu::TexelFormat::rgba16f);
    if (!sum) return pass_on(sum);
    sum_ = std::move(*sum);
    count_ = 0;
  }
  use(picture, 1.0F);
  const auto blending = count_ == 0 ? gpu::Blending::replace : gpu::Blending::add;
  TIDEMARK_TRY(sum_.fill(device, {}, blending));
  ++count_;
  use(sum_, 1.0F / static_cast<float>(count_));
  return picture.fill(device, {});
}

}  // namespace tidemark::renderer
