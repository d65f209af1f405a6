// A study with its surface, ready to be drawn as the options of render say.
#pragma once

#include <memory>

#include "app/cli/console.h"
#include "app/cli/image_files.h"
#include "app/cli/render_options.h"
#include "core/volume.h"
#include "imaging/grid_policy.h"
#include "renderer/renderer.h"

namespace tidemark::cli {

struct Scene {
  std::shared_ptr<const Volume> source;
  Views views;
  std::unique_ptr<renderer::Renderer> renderer;
  StudyPlace study;
};

// Loads the study, its surface and its labels, and makes the renderer. Fails as these do, and with
// ErrorKind::cancelled.
Result<Scene> make_scene(const RenderOptions& options, Views views, Console& console,
                         const imaging::GridPolicy& otherwise = {});

// Fills in the facts of the study: its common values, and the middle of its surface.
void place(Scene& scene, const RenderOptions& options, const solver::Field& phi);

// Whether what place() fills in depends on the surface.
[[nodiscard]] bool goes_by_surface(const RenderOptions& options);

Result<renderer::Picture> draw(Scene& scene, const RenderOptions& options, const Progress& progress);

}  // namespace tidemark::cli
