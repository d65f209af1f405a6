// tidemark-cli sweep: many runs from one start, over one or two parameters.
#include <filesystem>
#include <memory>

#include "app/cli/outputs.h"
#include "app/cli/program.h"
#include "app/cli/run_inputs.h"
#include "app/cli/sweep_files.h"
#include "core/stopwatch.h"
#include "document/sweep_picture.h"
#include "imaging/files/png_file.h"

namespace tidemark::cli {
namespace {

constexpr CommandHelp kSweep{
    "sweep", "Runs a segmentation over values of one or two parameters",
    "Segments INPUT as segment does, once for each combination of the values of one or two parameters, "
    "several\n"
    "at once. Writes DIR/sweep.csv, a line a run with volume, outcome and Dice, and DIR/sweep.png: a slice "
    "of\n"
    "every run in a matrix, and the share of runs that have a voxel inside. The same options with one\n"
    "combination give the same voxels with segment --executor host. All runs have one start: --init-speed "
    "takes\n"
    "no axis that changes the speed, --auto-start none over target or range. An interrupted run writes "
    "nothing.",
    "  tidemark-cli sweep brain/ --target 800 --seed 90,110,80,5 --over alpha=0.2:0.9:6 --over "
    "range=30:120:6 "
    "\\\n"
    "      --out brain-sweep\n"
    "  tidemark-cli sweep ct.nrrd --target 100 --range 40 --seed-mm=-60,20,110,8 --over alpha=0.1:0.8:8 \\\n"
    "      --truth liver.nii.gz --out alphas\n"};

struct SweepArguments {
  SegmentOptions segment;
  std::vector<std::string> over;
  std::string out;
};

// The folder of the results: one that was made for them goes away again unless they come.
class ResultFolder {
 public:
  explicit ResultFolder(std::filesystem::path folder) : folder_(std::move(folder)) {}
  ~ResultFolder() {
    std::error_code ignored;
    if (made_) std::filesystem::remove(folder_, ignored);  // only when it is empty
  }
  ResultFolder(const ResultFolder&) = delete;
  ResultFolder& operator=(const ResultFolder&) = delete;

  Status make() {
    std::error_code error;
    made_ = std::filesystem::create_directories(folder_, error);
    if (error) {
      return fail(ErrorKind::write, "--out {}: cannot be made: {}", folder_.string(), error.message());
    }
    return {};
  }
  [[nodiscard]] std::filesystem::path operator/(const char* name) const { return folder_ / name; }

 private:
  std::filesystem::path folder_;
  bool made_ = false;
};

// One run of the command.
class SweepCommand {
 public:
  SweepCommand(Program& program, const SweepArguments& arguments)
      : console_(program.console),
        options_(arguments.segment),
        over_(arguments.over),
        folder_(arguments.out),
        table_(folder_ / "sweep.csv"),
        picture_(folder_ / "sweep.png") {}

  Status run();

 private:
  Status read_axes();
  Status prepare();
  Result<document::Sweep> compute();
  Status write(const document::Sweep& sweep);
  void say(const document::Sweep& sweep, double seconds);

  Console& console_;
  SegmentOptions options_;
  std::vector<std::string> over_;
  ResultFolder folder_;
  std::filesystem::path table_, picture_;
  Outputs outputs_;
  std::vector<document::SweepAxis> axes_;
  RunResults inputs_;
  std::optional<BitMask> truth_;
};

// All runs have one start: no axis may change what it is made from.
Status check_start(const SegmentOptions& options, const std::vector<document::SweepAxis>& axes) {
  for (const document::SweepAxis& axis : axes) {
    const bool is_of_tent = axis.parameter == "target" || axis.parameter == "range";
    const bool is_of_speed = is_of_tent || document::is_of_speed(axis.parameter);
    const char* const option = options.start.speed && is_of_speed ? "--init-speed"
                               : options.auto_start && is_of_tent ? "--auto-start"
                                                                  : nullptr;
    if (option == nullptr) continue;
    return fail(ErrorKind::usage,
                "--over {}: the start that {} makes depends on it, and all runs of a sweep have one start",
                axis.parameter, option);
  }
  return {};
}

Status SweepCommand::run() {
  TIDEMARK_TRY(read_axes());
  TIDEMARK_TRY(check(options_));
  TIDEMARK_TRY(check_start(options_, axes_));
  TIDEMARK_TRY(prepare());
  auto truth = read_inputs(options_, false, console_, inputs_);
  if (!truth) return pass_on(truth);
  truth_ = std::move(*truth);
  const Stopwatch watch;
  const auto sweep = compute();
  if (!sweep) return pass_on(sweep);
  const double seconds = watch.seconds();
  TIDEMARK_TRY(write(*sweep));
  say(*sweep, seconds);
  return {};
}

// A swept parameter needs no option of its own: its first value stands in for it.
Status SweepCommand::read_axes() {
  for (const std::string& text : over_) {
    auto axis = document::parse_sweep_axis(text);
    if (!axis) return fail(axis.error().kind, "--over {}", axis.error().message);
    for (const auto& [name, value] :
         {std::pair("target", &options_.target), std::pair("range", &options_.range),
          std::pair("alpha", &options_.alpha)}) {
      if (axis->parameter == name) *value = axis->from;
    }
    axes_.push_back(std::move(*axis));
  }
  return {};
}

Status SweepCommand::prepare() {
  TIDEMARK_TRY(folder_.make());
  TIDEMARK_TRY(outputs_.announce_csv("--out", table_));
  TIDEMARK_TRY(outputs_.announce_png("--out", picture_));
  TIDEMARK_TRY(spare_study(outputs_, options_.study, console_.progress()));
  return spare_inputs(outputs_, inputs_of(options_), console_.progress());
}

Result<document::Sweep> SweepCommand::compute() {
  const document::Recipe& recipe = inputs_.recipe;
  if (recipe.drive != nullptr) console_.say("Speed      {}", describe(*recipe.drive));
  console_.say("Start      {}", recipe.start.describe());
  document::SweepOptions sweep;
  sweep.axes = axes_;
  sweep.steps = recipe.steps;
  sweep.until_converged = options_.until_converged();
  const solver::ExecutorOptions executor = options_.solver.executor_options();
  sweep.threads = executor.threads;
  sweep.memory_budget_bytes = executor.memory_budget_bytes;
  sweep.skip_quiet_pages = executor.skip_quiet_pages;
  if (truth_) sweep.truth = std::make_shared<const Region>(*truth_);
  const document::Drive drive = document::value_of(recipe.drive);
  if (const Status good = document::check(axes_, recipe.parameters, drive.setting); !good) {
    return fail(good.error().kind, "--over: {}", good.error().message);
  }
  const auto start = document::sweep_start(recipe, inputs_.source, console_.progress());
  if (!start) return pass_on(start);
  return document::run_sweep(*start, sweep, console_.progress());
}

Status SweepCommand::write(const document::Sweep& sweep) {
  TIDEMARK_TRY(outputs_.stage(
      table_, [&](const std::filesystem::path& file) { return write_file(file, sweep_table(sweep)); }));
  const renderer::Picture picture = sweep_sheet(sweep, *inputs_.source);
  TIDEMARK_TRY(outputs_.stage(picture_, [&](const std::filesystem::path& file) {
    return imaging::write_png_file(picture.width, picture.height, picture.pixels, file);
  }));
  return outputs_.commit(console_.progress());
}

void SweepCommand::say(const document::Sweep& sweep, double seconds) {
  const document::SweepScale volumes = document::volume_scale(sweep);
  console_.say("Runs       {} in {:.2f} s", sweep.runs.size(), seconds);
  console_.say("Volume     {:.3f} to {:.3f} ml", volumes.low, volumes.high);
  const auto best = std::max_element(sweep.runs.begin(), sweep.runs.end(),
                                     [](const auto& a, const auto& b) { return a.dice < b.dice; });
  if (best->dice) {
    std::string where;
    const auto index = static_cast<int>(best - sweep.runs.begin());
    for (std::size_t i = 0; i < sweep.axes.size(); ++i) {
      const int at = i == 0 ? index % sweep.columns() : index / sweep.columns();
      where += fmt::format("{}{} {}", i == 0 ? "" : ", ", sweep.axes[i].parameter, sweep.axes[i].value(at));
    }
    console_.say("Dice       {:.4f} at best: {}", *best->dice, where);
  }
  const auto without_end = std::count_if(sweep.runs.begin(), sweep.runs.end(),
                                         [](const auto& run) { return !run.problem.empty(); });
  if (without_end > 0) {
    console_.warn(fmt::format("{} runs needed more memory than their share of the budget", without_end));
  }
  console_.say("Wrote      {}", table_.string());
  console_.say("Wrote      {}", picture_.string());
  Json object = sweep_json(sweep);
  object["seconds"] = seconds;
  object["table"] = table_.string();
  object["picture"] = picture_.string();
  console_.result(object);
}

}  // namespace

void add_sweep(CLI::App& app, Program& program) {
  auto arguments = std::make_shared<SweepArguments>();
  CLI::App& command = add_command(app, program, kSweep,
                                  [&program, arguments] { return SweepCommand(program, *arguments).run(); });
  add_sweep_options(command, arguments->segment);
  command
      .add_option(
          "--over", arguments->over,
          "A parameter with its first value, its last, and how many (2 to 8): alpha, rescale, target,\n"
          "range, or a number of a speed function in use as FUNCTION.NAME; once or twice")
      ->allow_extra_args(false)
      ->required()
      ->type_name("NAME=FROM:TO:COUNT");
  command.add_option("--out", arguments->out, "The folder to write to; made when it is not there")
      ->required()
      ->type_name("DIR");
}

}  // namespace tidemark::cli
