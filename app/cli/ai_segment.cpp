// tidemark-cli ai segment: what a model on a server finds in a volume.
#include <algorithm>

#include "app/cli/ai_commands.h"
#include "app/cli/arguments.h"
#include "app/cli/audit.h"
#include "app/cli/outputs.h"
#include "app/cli/study_input.h"
#include "imaging/ai/ai_services.h"
#include "imaging/files/volume_file.h"

namespace tidemark::cli {
namespace {

constexpr CommandHelp kAiSegment{
    "segment", "Has a model of a server segment a volume",
    "Sends INPUT to a server and writes what its model finds: numbers of labels, or a probability from 0 to "
    "1.\n"
    "What is sent are the voxels, their spacing, place and direction, and the clicks: no name, no number "
    "and\n"
    "no DICOM header. The command says where they went.",
    "  tidemark-cli ai segment main ct/ --model segmentation_spleen --out labels.nii.gz\n"
    "  tidemark-cli ai segment main ct/ --model nnInteractive --point inside:120,140,30 \\\n"
    "      --point outside:90,140,30 --out mask.nii.gz\n"
    "  tidemark-cli segment ct/ --init mask.nii.gz --target 100 --range 40 --alpha 0.5 --out "
    "better.nii.gz\n"};

struct AiSegmentOptions {
  ServerChoice choice;
  StudyInput study;
  std::string model;
  std::string label;
  std::vector<std::string> points;
  std::string out;
};

// "inside:12,40,7"
Result<imaging::AiClicks> parse_clicks(const std::vector<std::string>& points) {
  imaging::AiClicks clicks;
  for (const std::string& point : points) {
    const std::size_t colon = point.find(':');
    const std::string side = point.substr(0, colon);
    const auto wrong = [&] {
      return fail(ErrorKind::usage, "--point {}: inside:I,J,K or outside:I,J,K is wanted, with whole numbers",
                  point);
    };
    if (colon == std::string::npos || (side != "inside" && side != "outside")) return wrong();
    const auto numbers = parse_numbers(std::string_view(point).substr(colon + 1), 3);
    if (!numbers) return wrong();
    Index3 voxel(0);
    for (int axis = 0; axis < 3; ++axis) {
      const double number = (*numbers)[static_cast<std::size_t>(axis)];
      if (number < 0.0 || number > 1e9 || number != std::floor(number)) return wrong();
      voxel[axis] = static_cast<std::int64_t>(number);
    }
    (side == "inside" ? clicks.inside : clicks.outside).push_back(voxel);
  }
  return clicks;
}

Result<imaging::AiModel> find_model(const imaging::AiServer& server, const AiSegmentOptions& options,
                                    Console& console) {
  const auto models = imaging::ai_models(server, console.progress());
  if (!models) return pass_on(models);
  std::string known;
  for (const imaging::AiModel& model : *models) {
    known += (known.empty() ? "" : ", ") + model.name;
    if (model.name != options.model) continue;
    const auto is_wanted = [&](const imaging::AiLabel& label) { return label.name == options.label; };
    if (options.label.empty() || std::any_of(model.labels.begin(), model.labels.end(), is_wanted))
      return model;
    return fail(ErrorKind::usage, "--label {}: the model {} has no such label", options.label, model.name);
  }
  return fail(ErrorKind::usage, "--model {}: the server {} has no such model: {}", options.model, server.name,
              known.empty() ? "it has none for volumes" : "it has " + known);
}

Status run(Program& program, const AiSegmentOptions& options) {
  Console& console = program.console;
  auto clicks = parse_clicks(options.points);
  if (!clicks) return pass_on(clicks);
  Outputs outputs;
  TIDEMARK_TRY(outputs.announce("--out", options.out, {FileForm::volume}));
  TIDEMARK_TRY(spare_study(outputs, options.study, console.progress()));
  const auto server = chosen_ai_server(options.choice);
  if (!server) return pass_on(server);
  const auto loaded = load_study(options.study, console.progress());
  if (!loaded) return pass_on(loaded);
  auto model = find_model(*server, options, console);
  if (!model) return pass_on(model);
  auto answer =
      imaging::ai_segment(*server, loaded->volume,
                          {*model, options.label, std::move(*clicks), audited_studies()}, console.progress());
  if (!answer) return pass_on(answer);
  console.say("Sent to    {}", describe(*server));
  const std::int64_t inside = imaging::mask_of(*answer).count();
  const double ml = static_cast<double>(inside) * answer->geometry.voxel_volume_ml();
  console.say("Found      {} voxels, {:.2f} ml{}", inside, ml,
              answer->is_probability ? ", where the probability is at least one half" : "");
  Volume volume;
  volume.geometry = answer->geometry;
  volume.voxels = std::move(answer->values);
  TIDEMARK_TRY(outputs.stage(options.out, [&](const std::filesystem::path& file) {
    return imaging::write_volume_file(volume, file);
  }));
  TIDEMARK_TRY(outputs.commit(console.progress()));
  console.say("Wrote      {}", options.out);
  console.result({{"server", server->name},
                  {"url", server->access.url},
                  {"encrypted", server->is_encrypted()},
                  {"model", model->name},
                  {"form", answer->is_probability ? "probability" : "labels"},
                  {"voxels", inside},
                  {"volume_ml", ml},
                  {"file", options.out}});
  return {};
}

}  // namespace

void add_ai_segment(CLI::App& ai, Program& program) {
  auto options = std::make_shared<AiSegmentOptions>();
  CLI::App& command =
      add_command(ai, program, kAiSegment, [&program, options] { return run(program, *options); });
  add_server_choice(command, options->choice);
  add_study_input(command, options->study);
  command.add_option("--model", options->model, "The name of a model, as ai models has it")
      ->required()
      ->type_name("NAME");
  command
      .add_option("--label", options->label, "The label that clicks inside belong to; else the model's first")
      ->type_name("NAME");
  command
      .add_option("--point", options->points,
                  "A click inside or outside of what is to be found, in 0-based voxels; may be repeated")
      ->allow_extra_args(false)
      ->type_name("inside|outside:I,J,K");
  command.add_option("--out", options->out, "The file for labels or probability")
      ->required()
      ->type_name("FILE.nii.gz|.nii|.nrrd|.mha");
}

}  // namespace tidemark::cli
