#include "engine/film.h"

#include <utility>
#include <variant>

#include "document/evolution.h"
#include "imaging/files/gif_file.h"
#include "renderer/renderer.h"

namespace tidemark::engine {
namespace {

constexpr std::int64_t kPictures = 60;
constexpr double kPictureSeconds = 0.05;  // of each picture

// Pictures of a level set while it runs, by the processor.
class Camera {
 public:
  Camera(std::unique_ptr<renderer::Renderer> renderer, AnyView view, renderer::PictureSize size,
         imaging::GifFile& film)
      : renderer_(std::move(renderer)), view_(std::move(view)), size_(size), film_(film) {}

  Status shoot(const solver::Executor& executor, const std::stop_token& stop) {
    TIDEMARK_TRY(renderer::show(*renderer_, executor));
    const auto picture = std::visit(
        [&](const auto& view) -> Result<renderer::Picture> {
          return renderer_->draw(view, size_, Progress{nullptr, stop});
        },
        view_);
    if (!picture) return pass_on(picture);
    return film_.add(picture->pixels);
  }

 private:
  std::unique_ptr<renderer::Renderer> renderer_;
  AnyView view_;
  renderer::PictureSize size_;
  imaging::GifFile& film_;
};

}  // namespace

Status write_film(const document::Recipe& recipe, const std::shared_ptr<const Volume>& volume,
                  const AnyView& view, renderer::PictureSize size, const std::filesystem::path& file,
                  const Progress& progress) {
  if (recipe.steps == 0) {
    return fail(ErrorKind::usage, "the surface has not moved yet: there is nothing to film");
  }
  auto film = imaging::GifFile::create(size.width, size.height, kPictureSeconds, file);
  if (!film) return pass_on(film);
  const PageLayout layout(volume->geometry.size, kDefaultPageShape);
  auto renderer = renderer::make_renderer(renderer::RendererKind::host, nullptr, volume, layout);
  if (!renderer) return pass_on(renderer);
  Camera camera(std::move(*renderer), view, size, *film);
  document::EvolutionOptions options;
  options.executor = solver::ExecutorKind::host;
  options.watch_every = document::watch_every_for(kPictures, recipe.steps);
  options.watch = [&](solver::Executor& executor, std::int64_t) {
    return camera.shoot(executor, progress.stop);
  };
  auto evolution = document::evolve(recipe, volume, options, progress);
  if (!evolution) return pass_on(evolution);
  return film->finish();
}

}  // namespace tidemark::engine
