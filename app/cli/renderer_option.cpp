#include "app/cli/renderer_option.h"

#include <string>

#include "gpu/device.h"

namespace tidemark::cli {
namespace {

renderer::RendererKind renderer_kind(const std::string& name) {
  if (const auto kind = renderer::renderer_named(name)) return *kind;
  throw CLI::ValidationError("--renderer", "'" + name + "' is unknown; use auto, host or gl");
}

}  // namespace

CLI::Option* add_renderer_option(CLI::App& app, renderer::RendererKind& kind) {
  return app
      .add_option_function<std::string>(
          "--renderer", [&kind](const std::string& name) { kind = renderer_kind(name); },
          "What draws: gl (OpenGL 3.3), host (the processor; it needs no OpenGL), or auto: gl on a GPU,\n"
          "else host (default: auto)")
      ->type_name("auto|host|gl");
}

Result<ChosenRenderer> choose_renderer(renderer::RendererKind asked) {
  if (asked == renderer::RendererKind::host) return ChosenRenderer{};
  auto device = gpu::Device::create_headless({gpu::GlVersion::gl33, false});
  if (!device && asked == renderer::RendererKind::gl) return pass_on(device);
  const auto kind = renderer::chosen_kind(asked, device ? device->get() : nullptr);
  if (kind == renderer::RendererKind::host) return ChosenRenderer{};
  return ChosenRenderer{kind, std::move(*device)};
}

}  // namespace tidemark::cli
