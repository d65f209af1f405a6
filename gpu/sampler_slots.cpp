#include "gpu/sampler_slots.h"

#include <fmt/format.h>

namespace tidemark::gpu {
namespace {

constexpr int kUnit = 14;   // no other draw has a 2D texture there
constexpr int kSlots = 13;  // as in render/sampler_slots.frag

}  // namespace

Result<SamplerSlots> SamplerSlots::create(Device& device) {
  SamplerSlots slots;
  slots.needed_ = device.capabilities().software;
  if (!slots.needed_) return slots;
  auto program = Program::render(device, "render/full_view.vert", "", "render/sampler_slots.frag", {});
  if (!program) return pass_on(program);
  slots.program_ = std::move(*program);
  auto texture = Texture2D::create(device, TexelFormat::rgba8, 1, 1, "sampler slots");
  if (!texture) return pass_on(texture);
  slots.texture_ = std::move(*texture);
  auto framebuffer = Framebuffer::create(device, {&slots.texture_}, "sampler slots");
  if (!framebuffer) return pass_on(framebuffer);
  slots.framebuffer_ = std::move(*framebuffer);
  slots.vertices_ = VertexArray::create(device);
  slots.program_.use();
  for (int i = 0; i < kSlots; ++i) slots.program_.set(fmt::format("any[{}]", i).c_str(), kUnit);
  return slots;
}

void SamplerSlots::clear() const {
  if (!needed_) return;
  program_.use();
  texture_.bind(kUnit);
  framebuffer_.bind();
  vertices_.bind();
  begin_exact_drawing();
  // One vertex makes no triangle, but the driver looks at all that a draw needs.
  draw(Primitive::triangles, 1);
}

}  // namespace tidemark::gpu
