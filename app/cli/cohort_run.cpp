// tidemark-cli cohort run: the computation of what is not done.
#include <memory>

#include "app/cli/arguments.h"
#include "app/cli/cohort_commands.h"
#include "core/machine_memory.h"
#include "core/stopwatch.h"
#include "core/thread_pool.h"
#include "document/cohort/case_run.h"
#include "document/cohort/pacs_cases.h"
#include "document/cohort/runner.h"
#include "solver/host/host_executor.h"

namespace tidemark::cli {
namespace {

constexpr CommandHelp kCohortRun{
    "run", "Computes the cases of a cohort that are not done",
    "Computes each case of DIR that is not done, in a process of its own, several at once, by the host "
    "executor.\n"
    "A case appears in DIR/cases whole, or not at all, with DIR/cases/ID/status.json. One that fails, takes "
    "too\n"
    "long or too much memory gets its status, too, and the others go on. Run it again after an interrupt, or "
    "on\n"
    "several machines with one disk: no case is done twice. Cases without a result end with code 0, and are\n"
    "counted; --strict makes it 3, also for those of earlier runs.",
    "  tidemark-cli cohort run livers --jobs 8 --timeout 600\n"
    "  tidemark-cli cohort run livers --shard 3/20\n"
    "  tidemark-cli cohort run livers --retry --timeout 7200 --memory 16000\n"};

constexpr std::int64_t kMostJobs = 4096;
constexpr double kMostSeconds = 1e7;

struct RunArguments {
  std::string folder, shard;
  std::optional<std::int64_t> jobs, threads, memory_mb;
  std::optional<double> timeout_s, stale_after_s;
  bool retry = false, strict = false;
};

// "3/20"
Status read_shard(const std::string& text, cohort::RunOptions& options) {
  if (text.empty()) return {};
  const std::size_t slash = text.find('/');
  const auto index = parse_count(std::string_view(text).substr(0, slash));
  const auto count =
      parse_count(slash == std::string::npos ? std::string_view() : std::string_view(text).substr(slash + 1));
  if (!index || !count || *index < 1 || *index > *count) {
    return fail(ErrorKind::usage, "--shard {}: must be I/N with I from 1 to N", text);
  }
  options.shard = *index;
  options.shards = *count;
  return {};
}

Result<cohort::RunOptions> options_of(const RunArguments& arguments) {
  cohort::RunOptions options;
  TIDEMARK_TRY(read_shard(arguments.shard, options));
  const std::int64_t jobs = arguments.jobs.value_or(available_processors());
  if (jobs < 1 || jobs > kMostJobs) {
    return fail(ErrorKind::usage, "--jobs {}: must be 1 to {}", jobs, kMostJobs);
  }
  options.jobs = static_cast<int>(jobs);
  constexpr double kDefaultTimeout = 3600.0;
  options.timeout_s = arguments.timeout_s.value_or(kDefaultTimeout);
  if (options.timeout_s < 0.0 || options.timeout_s > kMostSeconds) {
    return fail(ErrorKind::usage, "--timeout {}: must be 0 (none) to {} s", options.timeout_s, kMostSeconds);
  }
  options.stale_after_s = arguments.stale_after_s.value_or(options.stale_after_s);
  if (options.stale_after_s < 1.0 || options.stale_after_s > kMostSeconds) {
    return fail(ErrorKind::usage, "--stale-after {}: must be 1 to {} s", options.stale_after_s, kMostSeconds);
  }
  if (arguments.memory_mb && (*arguments.memory_mb < 1 || *arguments.memory_mb > kMostMegabytes)) {
    return fail(ErrorKind::usage, "--memory {}: is out of range", *arguments.memory_mb);
  }
  options.memory_bytes = arguments.memory_mb ? *arguments.memory_mb * kMebibyte : machine_memory() / jobs;
  options.retry = arguments.retry;
  options.program = TIDEMARK_VERSION;
  return options;
}

Json to_json(const cohort::RunTally& tally, double seconds) {
  Json object;
  object["rows"] = tally.rows;
  object["before"] = tally.before;
  object["elsewhere"] = tally.elsewhere;
  object["computed"] = tally.computed();
  for (int outcome = 0; outcome < 5; ++outcome) {
    object[std::string(name_of(static_cast<cohort::CaseOutcome>(outcome)))] = tally.outcomes[outcome];
  }
  object["seconds"] = seconds;
  return object;
}

void say(Console& console, const cohort::RunTally& tally, double seconds) {
  console.say("Cases      {}, {} done before, {} computed now in {:.1f} s", tally.rows, tally.before,
              tally.computed(), seconds);
  if (tally.elsewhere > 0) console.say("Elsewhere  {}, which other runs do or have done", tally.elsewhere);
  if (tally.without_result() == 0) return;
  std::string text;
  for (int outcome = 1; outcome < 5; ++outcome) {
    if (tally.outcomes[outcome] == 0) continue;
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", tally.outcomes[outcome],
                        name_of(static_cast<cohort::CaseOutcome>(outcome)));
  }
  console.warn(fmt::format("{} cases have no result: {} (see cohort report)", tally.without_result(), text));
}

Status run(Program& program, const RunArguments& arguments) {
  Console& console = program.console;
  const auto options = options_of(arguments);
  if (!options) return pass_on(options);
  if (arguments.threads && (*arguments.threads < 1 || *arguments.threads > kMostJobs)) {
    return fail(ErrorKind::usage, "--threads {}: must be 1 to {}", *arguments.threads, kMostJobs);
  }
  const cohort::CohortFolder folder(std::filesystem::absolute(arguments.folder));
  const auto plan = folder.load_plan();
  if (!plan) return pass_on(plan);
  const auto list = folder.load_work_list();
  if (!list) return pass_on(list);

  const auto servers = cohort::servers_of(plan->servers_file, list->rows);
  if (!servers) return pass_on(servers);
  cohort::CaseRun one{*plan, 1, 0, TIDEMARK_VERSION, *servers, folder.cases()};
  one.threads = static_cast<int>(
      arguments.threads.value_or(std::max(1, static_cast<int>(available_processors()) / options->jobs)));
  // A quarter is for the study and what is written.
  one.memory_bytes = options->memory_bytes / 4 * 3;
  // By an instruction set that is not there each case would fail.
  TIDEMARK_TRY(solver::HostExecutor::chosen_kernels());
  const auto compute = [&](const cohort::WorkRow& row, const std::filesystem::path& to) {
    return cohort::run_case(one, row, to);
  };
  const Stopwatch watch;
  cohort::warm_up(one);
  const auto tally = cohort::run_cohort(folder, *list, *options, compute, console.progress());
  if (!tally) return pass_on(tally);
  say(console, *tally, watch.seconds());
  console.result(to_json(*tally, watch.seconds()));
  if (!arguments.strict) return {};
  const std::int64_t without_result = cohort::finished_without_result(folder, *list, *options);
  if (without_result == 0) return {};
  return fail(ErrorKind::input, "{} cases have no result (see cohort report)", without_result);
}

}  // namespace

void add_cohort_run(CLI::App& cohort, Program& program) {
  auto arguments = std::make_shared<RunArguments>();
  CLI::App& command =
      add_command(cohort, program, kCohortRun, [&program, arguments] { return run(program, *arguments); });
  add_cohort_folder(command, arguments->folder);
  add_count(command, "--jobs", arguments->jobs, "Cases at once (default: as many as there are processors)");
  add_count(command, "--threads", arguments->threads, "Threads of each case (default: processors by jobs)");
  command.add_option("--shard", arguments->shard, "Every N-th row alone, from the I-th on")->type_name("I/N");
  add_number(command, "--timeout", arguments->timeout_s,
             "Most seconds for a case (default: 3600; 0: no limit)");
  add_count(command, "--memory", arguments->memory_mb,
            "Most memory for a case, in MB (default: what this process may use, by jobs)");
  command.add_flag("--retry", arguments->retry, "Once more, the cases without a result");
  command.add_flag("--strict", arguments->strict, "End with code 3 when a case has no result");
  add_number(
      command, "--stale-after", arguments->stale_after_s,
      "Seconds without a sign of life after which another machine's case is taken over (default: 300)");
}

}  // namespace tidemark::cli
