// The pictures of a view that stay on the GPU, from the engine's context to the view's own.
#pragma once

#include <atomic>
#include <memory>
#include <vector>

#include "core/progress.h"
#include "renderer/gl/canvas.h"
#include "renderer/gl/canvas_mean.h"
#include "renderer/gl/gl_renderer.h"

namespace tidemark::engine {

class Engine;

// One texture. Its holder may read it in a context that shares with the engine's; nobody draws into it then.
class PictureTexture {
 public:
  PictureTexture(std::shared_ptr<gpu::Device> device, renderer::Canvas canvas)
      : device_(std::move(device)), canvas_(std::move(canvas)) {}
  PictureTexture(const PictureTexture&) = delete;
  PictureTexture& operator=(const PictureTexture&) = delete;
  ~PictureTexture() { (void)take_reader(); }

  [[nodiscard]] unsigned id() const { return canvas_.colour().id(); }
  [[nodiscard]] renderer::PictureSize size() const { return canvas_.size(); }
  // The fence (GLsync) behind the reader's last command that reads it, inserted and flushed. The fence before
  // it, which is returned, belongs to the reader again.
  [[nodiscard]] void* read_until(void* fence) const { return reader_.exchange(fence); }

 private:
  friend class ViewTextures;
  gpu::Fence take_reader() { return gpu::Fence::adopt(*device_, reader_.exchange(nullptr)); }

  std::shared_ptr<gpu::Device> device_;  // outlives the canvas, also when the engine has lost it
  renderer::Canvas canvas_;
  mutable std::atomic<void*> reader_{nullptr};
};

// The textures of one view: one that is seen, one that is about to be, and one to draw the next picture into.
// On the engine's thread.
class ViewTextures {
 public:
  static Result<std::shared_ptr<ViewTextures>> create(Engine& engine, std::shared_ptr<gpu::Device> device);

  void clear_mean() { mean_.clear(); }
  // Draws a picture, or `into_mean` the mean of it and those since clear_mean(), and waits until it is there.
  template <class View>
  Result<std::shared_ptr<const PictureTexture>> draw(renderer::GlRenderer& renderer, const View& view,
                                                     renderer::PictureSize size, bool into_mean,
                                                     const Progress& progress) {
    auto texture = free_texture(size);
    if (!texture) return pass_on(texture);
    renderer::Canvas& canvas = (*texture)->canvas_;
    TIDEMARK_TRY(renderer.draw_on(canvas, view, progress));
    if (into_mean) {
      TIDEMARK_TRY(mean_.replace_by_mean(*device_, canvas));
    }
    TIDEMARK_TRY(gpu::Fence::insert(*device_).wait());
    return std::shared_ptr<const PictureTexture>(std::move(*texture));
  }

 private:
  ViewTextures(Engine& engine, std::shared_ptr<gpu::Device> device, renderer::CanvasMean mean)
      : engine_(engine), device_(std::move(device)), mean_(std::move(mean)) {}
  Result<std::shared_ptr<PictureTexture>> free_texture(renderer::PictureSize size);

  Engine& engine_;
  std::shared_ptr<gpu::Device> device_;
  renderer::CanvasMean mean_;
  std::vector<std::shared_ptr<PictureTexture>> textures_;
};

}  // namespace tidemark::engine
