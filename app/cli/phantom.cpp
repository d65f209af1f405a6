// tidemark-cli phantom: a synthetic study with its ground truth.
#include <filesystem>
#include <memory>
#include <vector>

#include "app/cli/arguments.h"
#include "app/cli/program.h"
#include "app/cli/report.h"
#include "app/cli/shell_word.h"
#include "imaging/phantom/phantom.h"

namespace tidemark::cli {
namespace {

constexpr CommandHelp kPhantom{
    "phantom", "Writes a synthetic study with its ground truth",
    "Writes a synthetic study: DIR/series (DICOM), DIR/truth.nii.gz (the mask that is right) and\n"
    "DIR/phantom.json (target, range, alpha and a start that suit it: seed i,j,k in voxels with radius in "
    "mm,\n"
    "or init_threshold low,high). The same numbers give the same voxels on every machine.",
    "  tidemark-cli phantom head --out head\n"
    "  tidemark-cli phantom bridge --out noisy --noise 15 --random-seed 7\n"};

struct PhantomArguments {
  std::string kind;
  std::string out;
  std::optional<double> noise;
  std::optional<std::int64_t> random_seed;
};

std::string kinds() {
  std::string text;
  for (const std::string_view kind : imaging::phantom_kinds())
    text += (text.empty() ? "" : ", ") + std::string(kind);
  return text;
}

Json to_json(const imaging::Phantom& phantom, const std::filesystem::path& folder) {
  Json object;
  object["kind"] = phantom.kind;
  object["series"] = (folder / "series").string();
  object["truth"] = (folder / "truth.nii.gz").string();
  object["parameters"] = (folder / "phantom.json").string();
  object.update(grid_json(phantom.volume.geometry));
  object["target"] = phantom.target;
  object["range"] = phantom.range;
  object["alpha"] = phantom.alpha;
  if (phantom.seed) object["seed"] = *phantom.seed;
  if (phantom.init_threshold) {
    object["init_threshold"] = {phantom.init_threshold->first, phantom.init_threshold->second};
  }
  object["truth_voxels"] = phantom.truth.count();
  return object;
}

// The command line that segments it.
std::string next_command(const imaging::Phantom& phantom, const std::filesystem::path& folder) {
  std::string start;
  if (phantom.seed) {
    const auto& seed = *phantom.seed;
    start = fmt::format("--seed {},{},{},{}", seed[0], seed[1], seed[2], seed[3]);
  } else if (phantom.init_threshold) {
    start =
        fmt::format("--init-threshold={},{}", phantom.init_threshold->first, phantom.init_threshold->second);
  }
  return fmt::format("tidemark-cli segment {} --target {} --range {} --alpha {} {} --out {}",
                     shell_word((folder / "series").string()), phantom.target, phantom.range, phantom.alpha,
                     start, shell_word((folder / "mask.nii.gz").string()));
}

// Writes the study; when that fails, everything new is removed again.
Status write_or_clean_up(const imaging::Phantom& phantom, const std::filesystem::path& folder,
                         const Progress& progress) {
  std::vector<std::filesystem::path> fresh;
  std::error_code ignored;
  for (const auto& path : {folder / "series", folder / "truth.nii.gz", folder / "phantom.json"}) {
    if (!std::filesystem::exists(path, ignored)) fresh.push_back(path);
  }
  Status written = imaging::write_phantom(phantom, folder, progress);
  if (written && progress.cancelled()) written = cancelled_error();
  if (!written) {
    for (const auto& path : fresh) std::filesystem::remove_all(path, ignored);
    std::filesystem::remove(folder, ignored);  // only when it is empty
  }
  return written;
}

Status run(Program& program, const PhantomArguments& arguments) {
  Console& console = program.console;
  imaging::PhantomOptions options;
  options.noise_percent = arguments.noise.value_or(options.noise_percent);
  if (arguments.noise && (*arguments.noise < 0.0 || *arguments.noise > 100.0)) {
    return fail(ErrorKind::usage, "--noise {}: must be 0 to 100 %", *arguments.noise);
  }
  if (arguments.random_seed) options.random_seed = static_cast<std::uint64_t>(*arguments.random_seed);
  const auto phantom = imaging::make_phantom(arguments.kind, options, console.progress());
  if (!phantom) return pass_on(phantom);
  if (console.interrupted()) return cancelled_error();
  const std::filesystem::path folder = arguments.out;
  TIDEMARK_TRY(write_or_clean_up(*phantom, folder, console.progress()));

  const Index3 size = phantom->volume.geometry.size;
  console.say("Wrote      {}: {} x {} x {} voxels", (folder / "series").string(), size.x, size.y, size.z);
  console.say("Wrote      {}: {} voxels inside", (folder / "truth.nii.gz").string(), phantom->truth.count());
  console.say("Wrote      {}", (folder / "phantom.json").string());
  console.say("Next       {}", next_command(*phantom, folder));
  console.result(to_json(*phantom, folder));
  return {};
}

}  // namespace

void add_phantom(CLI::App& app, Program& program) {
  auto arguments = std::make_shared<PhantomArguments>();
  CLI::App& command =
      add_command(app, program, kPhantom, [&program, arguments] { return run(program, *arguments); });
  command.add_option("KIND", arguments->kind, "One of " + kinds())->required()->type_name("");
  command.add_option("--out", arguments->out, "The folder to write to; made when it is not there")
      ->required()
      ->type_name("DIR");
  add_number(command, "--noise", arguments->noise,
             "Standard deviation of the noise in % of the brightest tissue (default: the kind's own)");
  add_count(command, "--random-seed", arguments->random_seed,
            "Another number gives other noise (default: 1)");
}

}  // namespace tidemark::cli
