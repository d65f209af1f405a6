// The option --renderer: who draws pictures.
#pragma once

#include <CLI/App.hpp>
#include <memory>

#include "core/result.h"
#include "renderer/renderer.h"

namespace tidemark::cli {

CLI::Option* add_renderer_option(CLI::App& app, renderer::RendererKind& kind);

struct ChosenRenderer {
  renderer::RendererKind kind = renderer::RendererKind::host;  // host or gl
  std::shared_ptr<gpu::Device> device;                         // of gl
};
// Opens a device unless host is asked for. Fails (ErrorKind::capability) when gl is asked for and there is no
// OpenGL.
Result<ChosenRenderer> choose_renderer(renderer::RendererKind asked);

}  // namespace tidemark::cli
