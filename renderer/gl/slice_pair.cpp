#include "renderer/gl/slice_pair.h"

namespace tidemark::renderer {

Result<SlicePair> SlicePair::create(gpu::Device& device, const SliceAxis& axis, std::string_view label) {
  SlicePair pair;
  for (Place& place : pair.places_) {
    auto texture =
        gpu::Texture2D::create(device, gpu::TexelFormat::rgba32f, axis.width(), axis.height(), label);
    if (!texture) return pass_on(texture);
    place.texture = std::move(*texture);
    place.texture.set_filter(gpu::Filter::linear);
    auto framebuffer = gpu::Framebuffer::create(device, {&place.texture}, label);
    if (!framebuffer) return pass_on(framebuffer);
    place.framebuffer = std::move(*framebuffer);
  }
  return pair;
}

void SlicePair::begin(std::int64_t slice) {
  Place& place = places_[static_cast<std::size_t>(slice & 1)];
  place.slice = slice;
  place.framebuffer.bind();
}

void SlicePair::forget() {
  for (Place& place : places_) place.slice = -1;
}

}  // namespace tidemark::renderer
