// tidemark-cli film: a moving picture of an evolution, or of a turn of the camera.
#include <algorithm>
#include <memory>
#include <utility>

#include "app/cli/arguments.h"
#include "app/cli/outputs.h"
#include "app/cli/program.h"
#include "app/cli/recipe_files.h"
#include "app/cli/render_options.h"
#include "app/cli/scene.h"
#include "document/evolution.h"
#include "imaging/files/gif_file.h"

namespace tidemark::cli {
namespace {

constexpr CommandHelp kFilm{
    "film", "Makes a film of an evolution, or of a turn around a surface",
    "Draws INPUT as render does, picture after picture, into a GIF file that plays for ever.\n\n"
    "With --recipe the pictures show the surface as the recipe moves it, from its start to its end, one "
    "every\n"
    "--every steps; the steps are computed by the processor. With --turn the camera of --view 3d goes around "
    "by\n"
    "so many degrees of azimuth, over the whole film. With both it does so while the surface moves. Slices "
    "and\n"
    "--fit go by the surface at the end. --image and --speed-image give the images and the map that a "
    "recipe\n"
    "needs.",
    "  tidemark-cli film study/ --recipe liver.json --view axial --out growth.gif\n"
    "  tidemark-cli film study/ --mask liver.nii.gz --turn 360 --frames 90 --out liver.gif\n"
    "  tidemark-cli film study/ --recipe liver.json --every 5 --turn 90 --size 640x480 --out both.gif\n"};

constexpr std::int64_t kFrames = 60;
constexpr std::int64_t kMostFrames = 2000;
constexpr double kPicturesPerSecond = 20.0;
constexpr double kMostPerSecond = 50.0;  // browsers slow down what is faster

struct FilmOptions {
  RenderOptions render;
  std::optional<double> turn;  // degrees
  std::optional<std::int64_t> frames;
  std::optional<std::int64_t> every;  // steps
  std::optional<double> per_second;
};

Status check(const FilmOptions& options) {
  const bool evolves = !options.render.recipe.empty();
  if (!evolves && !options.turn) {
    return fail(ErrorKind::usage, "nothing moves: give --recipe or --turn");
  }
  if (options.every && !evolves) return fail(ErrorKind::usage, "--every counts steps of a --recipe");
  if (options.every && options.frames)
    return fail(ErrorKind::usage, "--every and --frames exclude each other");
  if (options.every && *options.every < 1)
    return fail(ErrorKind::usage, "--every {}: must be above 0", *options.every);
  if (options.frames && (*options.frames < 2 || *options.frames > kMostFrames)) {
    return fail(ErrorKind::usage, "--frames {}: must be 2 to {}", *options.frames, kMostFrames);
  }
  if (options.per_second && !(*options.per_second > 0.0 && *options.per_second <= kMostPerSecond)) {
    return fail(ErrorKind::usage, "--per-second {}: must be above 0 and at most {}", *options.per_second,
                kMostPerSecond);
  }
  if (options.turn && options.render.view != "3d") {
    return fail(ErrorKind::usage, "--turn moves the camera of --view 3d, not of --view {}",
                options.render.view);
  }
  return {};
}

// Of an evolution: the start, and one after every so many steps, also where the last are fewer.
std::int64_t frames_of(std::int64_t steps, std::int64_t every) {
  return (steps + every - 1) / every + 1;
}

// Steps from one picture to the next, for about so many pictures; for fewer where those would be too many.
std::int64_t steps_between(std::int64_t frames, std::int64_t steps) {
  const std::int64_t nearest = document::watch_every_for(frames, steps);
  return frames_of(steps, nearest) <= kMostFrames ? nearest : nearest + 1;
}

// Draws the pictures of a film, one after the other.
class Camera {
 public:
  Camera(Scene& scene, const FilmOptions& options, std::int64_t frames, imaging::GifFile& file)
      : scene_(scene), options_(options), frames_(frames), file_(file), from_(scene.views.volume.camera) {
    // At one scale, at which what is in view from its side is in view from all.
    const double zoom = from_.zoom;
    for (std::int64_t frame = 1; frame < frames; ++frame)
      from_.zoom = std::min(from_.zoom, zoom * from_.zoom / turned(frame).zoom);
  }

  Status shoot(const Progress& progress) {
    scene_.views.volume.camera = turned(shot_);
    const auto picture = draw(scene_, options_.render, progress);
    if (!picture) return pass_on(picture);
    ++shot_;
    return file_.add(picture->pixels);
  }
  [[nodiscard]] std::int64_t shot() const { return shot_; }

 private:
  [[nodiscard]] renderer::Camera turned(std::int64_t frame) const {
    // A whole turn ends one picture before its beginning, so that it goes on without a halt.
    const double share = static_cast<double>(frame) / static_cast<double>(frames_);
    return from_.turned_to(from_.azimuth + options_.turn.value_or(0.0) * share, from_.elevation,
                           scene_.source->geometry, scene_.views.size.aspect());
  }

  Scene& scene_;
  const FilmOptions& options_;
  std::int64_t frames_;
  imaging::GifFile& file_;
  renderer::Camera from_;
  std::int64_t shot_ = 0;
};

Status shoot_turn(Camera& camera, std::int64_t frames, Console& console) {
  const Progress progress = console.progress();
  for (std::int64_t frame = 0; frame < frames; ++frame) {
    if (progress.cancelled()) return cancelled_error();
    const Progress one = progress.part(static_cast<int>(frame), static_cast<int>(frames));
    one(0.0, "drawing");
    TIDEMARK_TRY(camera.shoot(one));
  }
  return {};
}

// In the pages that pictures are drawn from.
document::EvolutionOptions on_host() {
  document::EvolutionOptions options;
  options.executor = solver::ExecutorKind::host;
  return options;
}

Status shoot_evolution(Camera& camera, Scene& scene, const document::Recipe& recipe, std::int64_t every,
                       Console& console) {
  document::EvolutionOptions options = on_host();
  options.watch_every = every;
  options.watch = [&](solver::Executor& executor, std::int64_t) -> Status {
    if (console.interrupted()) return cancelled_error();
    TIDEMARK_TRY(renderer::show(*scene.renderer, executor));
    return camera.shoot({nullptr, console.progress().stop});
  };
  auto evolution = document::evolve(recipe, scene.source, options, console.progress());
  if (!evolution) return pass_on(evolution);
  return {};
}

Status run(Program& program, const FilmOptions& options) {
  Console& console = program.console;
  TIDEMARK_TRY(check(options));
  auto views = views_of(options.render);
  if (!views) return pass_on(views);
  Outputs outputs;
  TIDEMARK_TRY(outputs.announce_gif("--out", options.render.out));

  document::Recipe recipe;
  std::int64_t frames = options.frames.value_or(kFrames);
  std::int64_t every = 0;
  if (!options.render.recipe.empty()) {
    auto loaded = document::Recipe::load(options.render.recipe);
    if (!loaded) return pass_on(loaded);
    recipe = std::move(*loaded);
    every = options.every.value_or(steps_between(frames, recipe.steps));
    frames = frames_of(recipe.steps, every);
    if (frames > kMostFrames) {
      return fail(ErrorKind::usage, "--every {}: {} steps would make {} pictures; at most {}", every,
                  recipe.steps, frames, kMostFrames);
    }
  }
  TIDEMARK_TRY(spare_study(outputs, options.render.study, console.progress(), recipe.source.policy));
  TIDEMARK_TRY(spare_inputs(outputs, inputs_of(options.render), console.progress()));
  auto scene = make_scene(options.render, std::move(*views), console, recipe.source.policy);
  if (!scene) return pass_on(scene);
  if (every > 0) {
    for (const std::string& difference : document::differences(recipe, *scene->source))
      console.warn(difference);
    TIDEMARK_TRY(give_images(recipe, options.render.drive, scene->study, console));
    if (goes_by_surface(options.render)) {
      auto end = document::evolve(recipe, scene->source, on_host(), console.progress());
      if (!end) return pass_on(end);
      place(*scene, options.render, end->phi);
    }
  }

  const double per_second = options.per_second.value_or(kPicturesPerSecond);
  const renderer::PictureSize size = scene->views.size;
  std::int64_t shot = 0;
  const auto write = [&](const std::filesystem::path& name) -> Status {
    auto file = imaging::GifFile::create(size.width, size.height, 1.0 / per_second, name);
    if (!file) return pass_on(file);
    Camera camera(*scene, options, frames, *file);
    TIDEMARK_TRY(every > 0 ? shoot_evolution(camera, *scene, recipe, every, console)
                           : shoot_turn(camera, frames, console));
    shot = camera.shot();
    return file->finish();
  };
  TIDEMARK_TRY(outputs.stage(options.render.out, write));
  TIDEMARK_TRY(outputs.commit(console.progress()));
  console.say("Film       {} pictures of {} x {} pixels, {:.3g} a second, in {}", shot, size.width,
              size.height, per_second, options.render.out);
  Json object;
  object["file"] = options.render.out;
  object["width"] = size.width;
  object["height"] = size.height;
  object["frames"] = shot;
  object["per_second"] = per_second;
  object["renderer"] = scene->renderer->name();
  console.result(object);
  return {};
}

}  // namespace

void add_film(CLI::App& app, Program& program) {
  auto options = std::make_shared<FilmOptions>();
  CLI::App& command =
      add_command(app, program, kFilm, [&program, options] { return run(program, *options); });
  add_render_options(command, options->render);
  command.add_option("--recipe", options->render.recipe, "A recipe (.json) whose evolution is shown");
  add_number(command, "--turn", options->turn,
             "Degrees by which the camera goes around, towards the patient's left");
  add_count(command, "--frames", options->frames, "Pictures, about so many with --recipe (default: 60)");
  add_count(command, "--every", options->every, "Steps from one picture to the next");
  add_number(command, "--per-second", options->per_second, "Pictures a second (default: 20)");
  command.add_option("--out", options->render.out, "Film, .gif")->required();
}

}  // namespace tidemark::cli
