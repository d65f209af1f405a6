// tidemark-cli cohort submit: a script for the scheduler that the site has.
#include <memory>

#include "app/cli/arguments.h"
#include "app/cli/cohort_commands.h"
#include "app/cli/shell_word.h"
#include "core/atomic_file.h"
#include "document/cohort/cohort_folder.h"

namespace tidemark::cli {
namespace {

constexpr CommandHelp kCohortSubmit{
    "submit", "Writes a script for Slurm that computes a cohort",
    "Writes DIR/slurm.sh, an array of equal tasks. Each takes cases that nobody has until none is left, so "
    "that a\n"
    "task that is killed, requeued or drained costs no case, and any number of tasks will do. Prints the "
    "commands\n"
    "that submit it: more tasks than the site allows in an array are several arrays.",
    "  tidemark-cli cohort submit livers --slurm --tasks 40 --jobs 4 --memory 8000 --time 04:00:00\n"};

constexpr std::int64_t kMostTasks = 100'000;
constexpr std::int64_t kDefaultArray = 1000;  // Slurm's own default allows 1001

struct SubmitArguments {
  std::string folder, time, partition;
  bool slurm = false;
  std::optional<std::int64_t> tasks, largest_array, jobs, memory_mb;
};

// The folder of logs: Slurm replaces %j and the like in their names.
std::string log_name(const std::filesystem::path& folder) {
  std::string name;
  for (const char c : folder.string()) name += c == '%' ? "%%" : std::string(1, c);
  return name + "/slurm-%A_%a.log";
}

// Words that Slurm reads and no shell does: what is allowed is listed.
Status check_word(const char* option, const std::string& word) {
  const bool good = std::all_of(word.begin(), word.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '-' || c == ':' || c == '_' || c == ',';
  });
  if (good) return {};
  return fail(ErrorKind::usage, "{} {}: letters, digits and -:_, are allowed", option, word);
}

Status check(const SubmitArguments& arguments) {
  if (!arguments.slurm) return fail(ErrorKind::usage, "--slurm is needed: it is the scheduler that is known");
  TIDEMARK_TRY(check_word("--time", arguments.time));
  TIDEMARK_TRY(check_word("--partition", arguments.partition));
  for (const auto& [name, value, most] : {std::tuple("--tasks", arguments.tasks, kMostTasks),
                                          std::tuple("--largest-array", arguments.largest_array, kMostTasks),
                                          std::tuple("--jobs", arguments.jobs, std::int64_t{4096}),
                                          std::tuple("--memory", arguments.memory_mb, kMostMegabytes)}) {
    if (value && (*value < 1 || *value > most)) {
      return fail(ErrorKind::usage, "{} {}: must be 1 to {}", name, *value, most);
    }
  }
  return {};
}

std::string script_of(const SubmitArguments& arguments, const std::filesystem::path& folder) {
  const std::int64_t jobs = arguments.jobs.value_or(1);
  std::error_code ignored;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", ignored);
  std::string text =
      "#!/bin/bash\n# Submit it as `cohort submit` has printed. A task may be killed or requeued at any "
      "time.\n";
  text += fmt::format("#SBATCH --job-name=tidemark-cohort\n#SBATCH --cpus-per-task={}\n", jobs);
  // The whole of a task: its cases, and what the program itself takes.
  constexpr std::int64_t kOwnMegabytes = 500;
  if (arguments.memory_mb) {
    text += fmt::format("#SBATCH --mem={}M\n", jobs * *arguments.memory_mb + kOwnMegabytes);
  }
  if (!arguments.time.empty()) text += fmt::format("#SBATCH --time={}\n", arguments.time);
  if (!arguments.partition.empty()) text += fmt::format("#SBATCH --partition={}\n", arguments.partition);
  // Slurm warns the task before its end, so that its cases are given back at once.
  text += "#SBATCH --requeue\n#SBATCH --open-mode=append\n#SBATCH --signal=B:TERM@30\n";
  // Not all sites confine a task to the processors that it has asked for.
  text += fmt::format("exec {} cohort run {} --jobs {} --threads 1", shell_word(program.string()),
                      shell_word(folder.string()), jobs);
  if (arguments.memory_mb) text += fmt::format(" --memory {}", *arguments.memory_mb);
  return text + "\n";
}

Status run(Program& program, const SubmitArguments& arguments) {
  Console& console = program.console;
  TIDEMARK_TRY(check(arguments));
  const cohort::CohortFolder folder(std::filesystem::absolute(arguments.folder).lexically_normal());
  const auto plan = folder.load_plan();
  if (!plan) return pass_on(plan);
  const std::filesystem::path script = folder.path() / "slurm.sh";
  TIDEMARK_TRY(write_file(script, script_of(arguments, folder.path())));
  const std::int64_t tasks = arguments.tasks.value_or(1);
  const std::int64_t largest = arguments.largest_array.value_or(kDefaultArray);
  const std::string log = shell_word(log_name(folder.path()));
  Json commands = Json::array();
  console.say("Wrote      {}", script.string());
  for (std::int64_t begun = 0; begun < tasks; begun += largest) {
    const std::string command =
        fmt::format("sbatch --array=0-{} --output={} {}", std::min(largest, tasks - begun) - 1, log,
                    shell_word(script.string()));
    console.say("Next       {}", command);
    commands.push_back(command);
  }
  Json object;
  object["script"] = script.string();
  object["commands"] = std::move(commands);
  console.result(object);
  return {};
}

}  // namespace

void add_cohort_submit(CLI::App& cohort, Program& program) {
  auto arguments = std::make_shared<SubmitArguments>();
  CLI::App& command =
      add_command(cohort, program, kCohortSubmit, [&program, arguments] { return run(program, *arguments); });
  add_cohort_folder(command, arguments->folder);
  command.add_flag("--slurm", arguments->slurm, "For Slurm");
  add_count(command, "--tasks", arguments->tasks, "Tasks that share the cases (default: 1)");
  add_count(command, "--largest-array", arguments->largest_array,
            "Most tasks in an array, as the site's MaxArraySize allows (default: 1000)");
  add_count(command, "--jobs", arguments->jobs, "Cases at once, and processors, of each task (default: 1)");
  add_count(command, "--memory", arguments->memory_mb, "Most memory for a case, in MB");
  command.add_option("--time", arguments->time, "The time limit of a task, as Slurm writes it")
      ->type_name("HH:MM:SS");
  command.add_option("--partition", arguments->partition, "Where tasks run")->type_name("NAME");
}

}  // namespace tidemark::cli
