#include "engine/view_textures.h"

#include "engine/engine.h"

namespace tidemark::engine {

Result<std::shared_ptr<ViewTextures>> ViewTextures::create(Engine& engine,
                                                           std::shared_ptr<gpu::Device> device) {
  auto mean = renderer::CanvasMean::create(*device);
  if (!mean) return pass_on(mean);
  return engine.share(
      std::unique_ptr<ViewTextures>(new ViewTextures(engine, std::move(device), std::move(*mean))));
}

Result<std::shared_ptr<PictureTexture>> ViewTextures::free_texture(renderer::PictureSize size) {
  const auto is_free = [](const auto& texture) { return texture.use_count() == 1; };
  // Of another size than pictures have now; those that are still seen go next time.
  std::erase_if(textures_, [&](const auto& texture) { return is_free(texture) && texture->size() != size; });
  for (const auto& texture : textures_) {
    if (!is_free(texture)) continue;
    // The view has dropped it, but its GPU may still be reading.
    TIDEMARK_TRY(texture->take_reader().wait());
    return texture;
  }
  auto canvas = renderer::Canvas::create(*device_, size, gpu::TexelFormat::rgba8, gpu::Filter::linear);
  if (!canvas) return pass_on(canvas);
  textures_.push_back(engine_.share(std::make_unique<PictureTexture>(device_, std::move(*canvas))));
  return textures_.back();
}

}  // namespace tidemark::engine
