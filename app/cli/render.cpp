// tidemark-cli render: a picture of a study and its surface.
#include <algorithm>
#include <memory>
#include <utility>

#include "app/cli/outputs.h"
#include "app/cli/program.h"
#include "app/cli/render_options.h"
#include "app/cli/scene.h"
#include "imaging/files/png_file.h"

namespace tidemark::cli {
namespace {

constexpr CommandHelp kRender{
    "render", "Draws a picture of a study and its surface",
    "Draws INPUT, with the surface of a mask or of a saved phi, into a PNG file.\n\n"
    "  3d        the surface and, with --preset or --tf, the source as a volume rendering\n"
    "  axial, coronal, sagittal   a slice with the surface's outline\n"
    "  oblique   a slice across --normal\n"
    "  speed     the axial slice coloured by a term of the speed: orange where the surface grows, blue and\n"
    "            hatched where it shrinks\n"
    "  pages     which pages of the level set are resident\n"
    "  sheet     three slices, the speed map (with --target and --range, or --speed) and the 3D view on one "
    "sheet\n\n"
    "Positions are voxel indices; normals and planes are in patient coordinates (LPS, mm): what lies where\n"
    "N . x > D of --clip is hidden.",
    "  tidemark-cli render head.nii.gz --mask brain.nii.gz --out brain.png\n"
    "  tidemark-cli render study/ --preset ct-bone --camera 30,20 --size 800x800 --out bone.png\n"
    "  tidemark-cli render study/ --phi phi.nii.gz --view axial --at 0,0,40 --out slice.png\n"
    "  tidemark-cli render study/ --mask liver.nii.gz --preset ct-angio --roi inside --out vessels.png\n"
    "  tidemark-cli render study/ --mask liver.nii.gz --view sheet --size 1200x800 --out sheet.png\n"};

bool is_even(const renderer::Picture& picture) {
  const auto& pixels = picture.pixels;
  return std::equal(pixels.begin() + 4, pixels.end(), pixels.begin());
}

Status run(Program& program, const RenderOptions& options) {
  Console& console = program.console;
  auto views = views_of(options);
  if (!views) return pass_on(views);
  Outputs outputs;
  TIDEMARK_TRY(outputs.announce_png("--out", options.out));
  TIDEMARK_TRY(spare_study(outputs, options.study, console.progress()));
  TIDEMARK_TRY(spare_inputs(outputs, inputs_of(options), console.progress()));
  auto scene = make_scene(options, std::move(*views), console);
  if (!scene) return pass_on(scene);
  const auto picture = draw(*scene, options, console.progress());
  if (!picture) return pass_on(picture);
  if (is_even(*picture)) console.warn("the picture shows nothing but its background");
  const auto write = [&](const std::filesystem::path& name) {
    return imaging::write_png_file(picture->width, picture->height, picture->pixels, name);
  };
  TIDEMARK_TRY(outputs.stage(options.out, write));
  TIDEMARK_TRY(outputs.commit(console.progress()));
  console.say("Picture    {} x {} pixels in {}", picture->width, picture->height, options.out);
  Json object;
  object["file"] = options.out;
  object["width"] = picture->width;
  object["height"] = picture->height;
  object["renderer"] = scene->renderer->name();
  console.result(object);
  return {};
}

}  // namespace

void add_render(CLI::App& app, Program& program) {
  auto options = std::make_shared<RenderOptions>();
  CLI::App& command =
      add_command(app, program, kRender, [&program, options] { return run(program, *options); });
  add_render_options(command, *options);
  command.add_option("--out", options->out, "Picture, .png")->required();
}

}  // namespace tidemark::cli
