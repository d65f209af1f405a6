#include "renderer/renderer.h"

#include <utility>

#include "gpu/device.h"
#include "renderer/gl/gl_renderer.h"
#include "renderer/host/host_renderer.h"

namespace tidemark::renderer {

std::optional<RendererKind> renderer_named(std::string_view name) {
  if (name == "auto") return RendererKind::automatic;
  if (name == "host") return RendererKind::host;
  if (name == "gl") return RendererKind::gl;
  return std::nullopt;
}

RendererKind chosen_kind(RendererKind asked, const gpu::Device* device) {
  if (asked != RendererKind::automatic) return asked;
  return device != nullptr && !device->capabilities().software ? RendererKind::gl : RendererKind::host;
}

Result<std::unique_ptr<Renderer>> make_renderer(RendererKind kind, std::shared_ptr<gpu::Device> device,
                                                std::shared_ptr<const Volume> source,
                                                const PageLayout& layout, int threads) {
  if (chosen_kind(kind, device.get()) == RendererKind::host) {
    return HostRenderer::create(std::move(source), layout, threads);
  }
  if (device == nullptr) return fail(ErrorKind::capability, "the renderer 'gl' needs OpenGL 3.3");
  return GlRenderer::create(std::move(device), std::move(source), layout);
}

Status show(Renderer& renderer, const solver::Executor& executor) {
  auto phi = executor.snapshot();
  if (!phi) return pass_on(phi);
  TIDEMARK_TRY(renderer.set_phi(std::move(*phi)));
  renderer.set_parameters(executor.parameters());
  renderer.set_speed(executor.speed());
  return renderer.set_constraints(executor.constraints().get());
}

}  // namespace tidemark::renderer
